#include "app/report/heat_map.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>

namespace tyndall::test::heat_map_test {

namespace {

std::array<float, 3> at(const LinearImage& image, int x, int y) {
  const float* pixel = image.rgb.data() + 3 * (y * image.width + x);
  return {pixel[0], pixel[1], pixel[2]};
}

float brightness(const std::array<float, 3>& c) { return c[0] + c[1] + c[2]; }

}  // namespace

TEST_CASE("heat map: each pixel has its value's colour; beneath is the scale from 0 to 1") {
  constexpr int width = 200, height = 3, scale = height + 8;
  std::vector<float> values(width * height);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i) / static_cast<float>(values.size());
  const LinearImage map = heat_map(values, width, height);
  CHECK(map.width == width);
  CHECK(map.height == height + heat_scale_rows);
  REQUIRE(map.rgb.size() == 3u * width * (height + heat_scale_rows));
  for (int i = 0; i < width * height; ++i)
    CHECK(at(map, i % width, i / width) == heat(values[static_cast<std::size_t>(i)]));
  CHECK(at(map, 0, scale) == heat(0));
  CHECK(at(map, width - 1, scale) == heat(1));
  for (int x = 1; x < width; ++x) CHECK(brightness(at(map, x, scale)) >= brightness(at(map, x - 1, scale)));
  const auto bad = heat(std::numeric_limits<float>::quiet_NaN());  // stands out
  CHECK(bad[1] > 0.9f);
  CHECK(bad[0] + bad[2] < 0.1f);
  CHECK(heat(1)[0] == doctest::Approx(1));
}

TEST_CASE("heat map: the scale's ends and middle are marked, as far as there is room") {
  const auto lit = [](int width, int x0, int x1) {
    const LinearImage map = heat_map(std::vector<float>(static_cast<std::size_t>(width)), width, 1);
    int count = 0;
    for (int y = heat_scale_rows - 10; y <= heat_scale_rows; ++y)
      for (int x = x0; x < x1; ++x) count += brightness(at(map, x, y)) > 1;
    return count;
  };
  CHECK(lit(200, 0, 8) > 20);
  CHECK(lit(200, 80, 120) > 40);
  CHECK(lit(200, 192, 200) > 10);
  CHECK(lit(200, 8, 80) == 0);
  CHECK(lit(40, 8, 30) == 0);
  CHECK(lit(1, 0, 1) > 0);
}

}  // namespace tyndall::test::heat_map_test
