#include "core/compile/columns.h"
#include "core/textures/checker.h"
#include "core/textures/image.h"
#include "core/textures/noise.h"
#include "tests/support/statistics.h"

#include <doctest/doctest.h>

#include <random>

namespace tyndall::test::textures_test {
using Style = Noise<double>::Style;

TEST_CASE("checker: cells alternate, through the origin and far from it") {
  for (const long far : {0L, -1000L, 100000L, -2000001L})
    for (long x = -4; x <= 4; ++x)
      for (long y = -4; y <= 4; ++y)
        for (long z = -4; z <= 4; ++z)
          for (const float part : {0.0f, 0.25f, 0.75f}) {
            const Vec3f cell{static_cast<float>(far + x) + part, static_cast<float>(y) + part,
                             static_cast<float>(z) + part};
            REQUIRE(checker_odd(cell) == (((far + x + y + z) % 2 + 2) % 2 == 1));
          }
}

TEST_CASE("checker: the cell at the origin is even, its lower neighbours are odd") {
  CHECK_FALSE(checker_odd(Vec3f{0.5f, 0.5f, 0.5f}));
  CHECK(checker_odd(Vec3f{-0.5f, 0.5f, 0.5f}));
  CHECK(checker_odd(Vec3f{0.5f, -1e-30f, 0.5f}));
  CHECK_FALSE(checker_odd(Vec3f{-0.5f, -0.5f, 0.5f}));
  CHECK(checker_odd(Vec3f{-0.5f, -0.5f, -0.5f}));
}

TEST_CASE("checker: coordinates too large to tell cells apart give one of the two colours") {
  for (const float v : {1e10f, -1e10f, 3e38f, -3e38f, INFINITY, NAN}) {
    const Vec3f cell{v, 0.5f, 0.5f};
    const bool odd = checker_odd(cell);
    CHECK(odd == checker_odd(cell));
  }
}

namespace {

/// 4 columns, 2 rows; red counts columns, green rows from the top.
constexpr int width = 4, height = 2;
const std::vector<float>& ramp() {
  static const std::vector<float> texels = [] {
    std::vector<float> t;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) t.insert(t.end(), {static_cast<float>(x), static_cast<float>(y), 0.5f});
    return t;
  }();
  return texels;
}

Vec3f at(float u, float v) { return image_colour<float>(ramp().data(), width, height, {u, v, true}); }
Vec3f at_flat(float u, float v) { return image_colour<float>(ramp().data(), width, height, {u, v, false}); }

void check_uv(Vec3f outward, float expected_u, float expected_v) {
  const float size = length(outward);
  float u = -1, v = -1;
  sphere_uv((1 / size) * outward, u, v);
  CHECK(u == doctest::Approx(expected_u).epsilon(1e-6).scale(0));
  CHECK(v == doctest::Approx(expected_v).epsilon(1e-6).scale(0));
}

}  // namespace

TEST_CASE("image: texels' centres give their colours; v goes up") {
  for (int x = 0; x < width; ++x)
    for (int y = 0; y < height; ++y) {
      const Vec3f colour = at((static_cast<float>(x) + 0.5f) / width, 1 - (static_cast<float>(y) + 0.5f) / height);
      CHECK(colour.x == doctest::Approx(x));
      CHECK(colour.y == doctest::Approx(y));
      CHECK(colour.z == 0.5f);
    }
  CHECK(at(0.3f, 1.0f).y == 0.0f);  // the first row of the file is at the top
  CHECK(at(0.3f, 0.0f).y == 1.0f);
}

TEST_CASE("image: linear between texels") {
  CHECK(at(0.25f, 0.75f).x == doctest::Approx(0.5));
  CHECK(at(0.4375f, 0.75f).x == doctest::Approx(1.25));
  CHECK(at(0.375f, 0.5f).y == doctest::Approx(0.5));
  CHECK(at(0.375f, 0.625f).y == doctest::Approx(0.25));
}

TEST_CASE("image: u wraps around, v ends at the edge rows") {
  CHECK(at(0.0f, 0.75f).x == doctest::Approx(1.5));  // between the last column and the first
  CHECK(at(1.0f, 0.75f).x == doctest::Approx(1.5));
  CHECK(at(0.0625f, 0.75f).x == doctest::Approx(0.75));  // three quarters of the first column, a quarter of the last
  CHECK(at(0.9375f, 0.75f).x == doctest::Approx(2.25));
  for (const float u : {0.1f, 0.6f})
    for (const float revolutions : {1.0f, -1.0f, 7.0f})
      CHECK(at(u + revolutions, 0.3f).x == doctest::Approx(at(u, 0.3f).x).epsilon(1e-5).scale(0));
  for (const float v : {1.0f, 1.5f, 100.0f, 1e30f}) CHECK(at(0.125f, v).y == 0.0f);
  for (const float v : {0.0f, -0.5f, -1e30f}) CHECK(at(0.125f, v).y == 1.0f);
}

TEST_CASE("image: on what is not closed, u ends at the edge columns: neither edge has anything of the other") {
  for (const float u : {0.0f, 0.0625f, 0.125f, -1e-7f, -0.5f, -1e30f}) CHECK(at_flat(u, 0.75f).x == 0.0f);
  for (const float u : {1.0f, 0.9375f, 0.875f, 1.0000001f, 1.5f, 1e30f}) CHECK(at_flat(u, 0.75f).x == 3.0f);
  for (float u = 0.125f; u <= 0.875f; u += 0.03125f) CHECK(at_flat(u, 0.3f) == at(u, 0.3f));
}

TEST_CASE("image: never reads beyond the table, whatever u and v are") {
  for (const float u :
       {-1e30f, -1e-9f, -0x1p-30f, 0.0f, 1.0f, 0x1.fffffep-1f, 16777217.0f, 3e38f, INFINITY, -INFINITY, NAN})
    for (const float v : {-3e38f, 0.0f, 0x1.fffffep-1f, 1.0f, INFINITY, -INFINITY, NAN})
      at(u, v), at_flat(u, v);  // the sanitizers' builds find reads beyond the table
  const std::vector<float> single{0.25f, 0.5f, 0.75f};
  for (const float u : {0.0f, 0.3f, 1.0f})
    for (const bool wraps : {false, true})
      CHECK(image_colour<float>(single.data(), 1, 1, {u, 1 - u, wraps}) == Vec3f{0.25f, 0.5f, 0.75f});
}

TEST_CASE("sphere uv: v from the south pole up, u eastwards from -x") {
  check_uv({1, 0, 0}, 0.5f, 0.5f);
  check_uv({0, 0, 1}, 0.25f, 0.5f);
  check_uv({0, 0, -1}, 0.75f, 0.5f);
  check_uv({1, 0, 1}, 0.375f, 0.5f);
  check_uv({-1, 0, 1}, 0.125f, 0.5f);
  check_uv({-1, 0, -1}, 0.875f, 0.5f);
  check_uv({1, 1, 0}, 0.5f, 0.75f);
  check_uv({1, -1, 0}, 0.5f, 0.25f);
  float u, v;
  sphere_uv(Vec3f{0, 1, 0}, u, v);
  CHECK(v == doctest::Approx(1));
  sphere_uv(Vec3f{0, -1, 0}, u, v);
  CHECK(v == doctest::Approx(0));
  sphere_uv(Vec3f{0, 1.0000001f, 0}, u, v);  // a unit vector rounded up
  CHECK(v == doctest::Approx(1));
  sphere_uv(Vec3f{-1, 0, 0}, u, v);
  CHECK((std::abs(u) < 1e-6f || std::abs(u - 1) < 1e-6f));
}

namespace {

const float* table() {
  static const auto gradients = gradient_table();
  return gradients;
}

/// Random points whose coordinates have about 12 binary places, so that adding whole periods to them is exact.
class Points {
 public:
  Vec3f next() { return {one(), one(), one()}; }

 private:
  float one() { return static_cast<float>(static_cast<int>(engine_() % 65536) - 32768) / 512.0f; }
  std::mt19937 engine_{1};
};

}  // namespace

TEST_CASE("noise: gradients are unit vectors without a preferred direction") {
  Vec3d sum;
  for (int i = 0; i < 256; ++i) {
    const float* g = table() + 3 * i;
    const Vec3d v{g[0], g[1], g[2]};
    CHECK(length(v) == doctest::Approx(1).epsilon(1e-6).scale(0));
    sum = sum + v;
  }
  CHECK(length(sum) < 4 * std::sqrt(256.0 / 3) * 1.5);
}

TEST_CASE("noise: zero at lattice points, bounded, and not flat") {
  for (int x = -5; x <= 5; ++x)
    for (int y = -5; y <= 5; ++y)
      CHECK(gradient_noise(Vec3f{static_cast<float>(x), static_cast<float>(y), static_cast<float>(x * y - 300)},
                           table()) == 0.0f);
  Points points;
  test::Moments moments;
  for (int i = 0; i < 200000; ++i) {
    const float n = gradient_noise(points.next(), table());
    REQUIRE(std::abs(n) <= 1.0f);
    moments.add(static_cast<double>(n));
  }
  CHECK(std::abs(moments.estimate().mean) < 0.02);
  CHECK(moments.squares / moments.count > 0.02);
}

TEST_CASE("noise: continuous within cells and across their borders, with a continuous slope") {
  Points points;
  for (int i = 0; i < 20000; ++i) {
    Vec3f p = points.next();
    if (i % 2) p.x = std::floor(p.x);  // on a border
    const float h = 1.0f / 512;
    const auto at = [&](float dx) { return gradient_noise(Vec3f{p.x + dx, p.y, p.z}, table()); };
    const float left = (at(0) - at(-h)) / h, right = (at(h) - at(0)) / h;
    REQUIRE(std::abs(left) < 4.0f);
    REQUIRE(std::abs(right - left) < 0.1f);  // curvature times h
  }
}

TEST_CASE("noise: repeats every 256 cells and no sooner") {
  Points points;
  int equal_sooner = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vec3f p = points.next();
    const float here = gradient_noise(p, table());
    for (const Vec3f direction : {Vec3f{256, 0, 0}, Vec3f{0, -256, 0}, Vec3f{0, 0, 256}, Vec3f{-512, 256, 0}})
      REQUIRE(gradient_noise(p + direction, table()) == here);
    for (const Vec3f direction :
         {Vec3f{128, 0, 0}, Vec3f{0, 128, 0}, Vec3f{0, 0, 128}, Vec3f{1, -1, 0}, Vec3f{0, 1, -1}})
      equal_sooner += here != 0 && gradient_noise(p + direction, table()) == here ? 1 : 0;
  }
  CHECK(equal_sooner < 25);
}

TEST_CASE("noise: the same in double") {
  Points points;
  for (int i = 0; i < 5000; ++i) {
    const Vec3f p = points.next();
    const double n = gradient_noise(Vec3d{p.x, p.y, p.z}, table());
    REQUIRE(static_cast<double>(gradient_noise(p, table())) == doctest::Approx(n).epsilon(2e-6));
  }
}

TEST_CASE("noise: turbulence is the absolute sum of seven octaves, each half as strong and twice as fine") {
  Points points;
  for (int i = 0; i < 5000; ++i) {
    const Vec3f p = points.next();
    double sum = 0;
    for (int k = 0; k < 7; ++k)
      sum += std::ldexp(static_cast<double>(gradient_noise(std::ldexp(1.0f, k) * p, table())), -k);
    REQUIRE(static_cast<double>(turbulence(p, true, table())) == doctest::Approx(std::abs(sum)).epsilon(1e-5));
  }
}

TEST_CASE("noise: styles are grey values; marble waves across z and stays within [0, 1]") {
  Points points;
  float minimum = 1, maximum = 0;
  for (int i = 0; i < 100000; ++i) {
    const Vec3f p = points.next();
    const float phase = 4 * p.z / static_cast<float>(2 * pi);
    const float marble = noise_grey(Style::marble, p, phase, true, table());
    const double expected =
        0.5 * (1 + std::sin(4 * static_cast<double>(p.z) + 10 * static_cast<double>(turbulence(p, true, table()))));
    REQUIRE(marble >= 0.0f);
    REQUIRE(marble <= 1.0f);
    REQUIRE(std::abs(static_cast<double>(marble) - expected) < 2e-4);  // of angles up to 256
    minimum = std::min(minimum, marble), maximum = std::max(maximum, marble);
    REQUIRE(noise_grey(Style::perlin, p, 0.0f, true, table()) ==
            doctest::Approx(0.5f + 0.5f * gradient_noise(p, table())));
    REQUIRE(noise_grey(Style::turbulence, p, 0.0f, true, table()) == turbulence(p, true, table()));
    REQUIRE(turbulence(p, true, table()) <= 1.0f);
  }
  CHECK(minimum < 0.01f);
  CHECK(maximum > 0.99f);
}

}  // namespace tyndall::test::textures_test
