#include "core/textures/image.h"

#include <doctest/doctest.h>

namespace tyndall::test::image_test {

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

}  // namespace tyndall::test::image_test
