#include "core/textures/noise.h"

#include "core/compile/columns.h"
#include "tests/support/statistics.h"

#include <doctest/doctest.h>

#include <random>

namespace tyndall::test::noise_test {
using Style = Noise<double>::Style;

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

}  // namespace tyndall::test::noise_test
