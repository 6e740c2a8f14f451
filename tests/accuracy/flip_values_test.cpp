// FLIP against numbers that do not come from this project's reading of the paper: what the authors' own program says,
// and what can be worked out with pen and paper from published colours and from the integrals of the filters.
#include "core/accuracy/error.h"
#include "tests/support/capture.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace tyndall::test::flip_values_test {

namespace {

using Bytes = std::array<int, 3>;

struct Picture {
  int width = 0, height = 0;
  std::vector<float> rgb;
};

/// An sRGB byte as linear light (IEC 61966-2-1).
float decoded(int byte) {
  const double v = byte / 255.0;
  return static_cast<float>(v > 0.04045 ? std::pow((v + 0.055) / 1.055, 2.4) : v / 12.92);
}

template <class Colour>
Picture picture(int width, int height, Colour colour) {
  Picture out{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (const int byte : colour(x, y)) out.rgb.push_back(decoded(byte));
  return out;
}

Picture one_colour(float r, float g, float b, int size = 41) {
  Picture out{size, size, {}};
  for (int i = 0; i < size * size; ++i) out.rgb.insert(out.rgb.end(), {r, g, b});
  return out;
}

std::vector<float> flip(const Picture& image, const Picture& reference) {
  return flip_map(image.rgb, reference.rgb, image.width, image.height);
}

double at(const std::vector<float>& map, int width, int x, int y) {
  return static_cast<double>(map[static_cast<std::size_t>(y * width + x)]);
}

float highest(const std::vector<float>& map) { return *std::max_element(map.begin(), map.end()); }

/// FLIP in the middle of two pictures that have one colour each: nothing but the colours counts.
double between(const Picture& a, const Picture& b) { return at(flip(a, b), 41, 20, 20); }

Bytes pattern(int x, int y) { return {8 * x, 10 * y, (x / 8 + y / 8) % 2 ? 200 : 40}; }

/// The pattern with a white dot, a patch of other colours, and its lower third shifted by a pixel.
Bytes changed_pattern(int x, int y) {
  const auto [r, g, b] = pattern(x, y);
  if (x == 5 && y == 5) return {255, 255, 255};
  if (x >= 14 && x < 20 && y >= 3 && y < 9) return {b, r, g};
  return y >= 16 ? pattern(std::max(x - 1, 0), y) : Bytes{r, g, b};
}

}  // namespace

// The numbers are what compute_ldrflip() of the authors' Python program prints for these two pictures at 67 pixels a
// degree (github.com/NVlabs/flip, python/flip_api.py, commit 313517b4; its image filter replaced by SciPy's "correlate"
// with the mode "nearest", which does the same). Its colour matrices have other last digits than those of flip.cpp.
TEST_CASE("FLIP gives the numbers of its authors' program") {
  constexpr int width = 32, height = 24;
  const std::vector<float> map = flip(picture(width, height, changed_pattern), picture(width, height, pattern));
  struct Expected {
    int x, y;
    double flip;
  };
  for (const auto& [x, y, expected] : {Expected{5, 5, 0.637031},
                                       {6, 7, 0.178927},
                                       {16, 5, 0.812206},
                                       {14, 3, 0.527911},
                                       {20, 9, 0.268358},
                                       {8, 20, 0.323726},
                                       {31, 23, 0.138655},
                                       {16, 16, 0.193135},
                                       {0, 12, 0.002275},
                                       {27, 2, 0.003745}}) {
    CAPTURE_BOUND(x);
    CAPTURE_BOUND(y);
    CHECK(at(map, width, x, y) == doctest::Approx(expected).epsilon(2e-4));
  }
  double sum = 0;
  for (const float v : map) sum += static_cast<double>(v);
  CHECK(sum / (width * height) == doctest::Approx(0.150730).epsilon(2e-4).scale(0));
  CHECK(highest(map) == doctest::Approx(0.913078).epsilon(2e-4).scale(0));
}

// By hand. L*, a*, b* of the sRGB primaries (D65) as tables give them: red 53.24, 80.09, 67.20; green 87.73, -86.18,
// 83.18; blue 32.30, 79.19, -107.86. Hunt: a* and b* times L*/100: red (42.64, 35.78), green (-75.61, 72.98), blue
// (25.58, -34.84). HyAB distance of green and blue: 55.43 + sqrt(101.19^2 + 107.82^2) = 203.3, to the power 0.7:
// 41.28, the largest there is. 0.4 of it, 16.51, counts 0.95; what is above shares the remaining 0.05.
TEST_CASE("FLIP of pictures of one colour follows from published L*a*b* values") {
  const Picture black = one_colour(0, 0, 0), white = one_colour(1, 1, 1);
  const Picture red = one_colour(1, 0, 0), green = one_colour(0, 1, 0), blue = one_colour(0, 0, 1);
  CHECK(between(green, blue) == doctest::Approx(1).epsilon(1e-5).scale(0));
  // 100^0.7 = 25.12; 0.95 + 0.05 (25.12 - 16.51) / (41.28 - 16.51)
  CHECK(between(white, black) == doctest::Approx(0.96738).epsilon(1e-4).scale(0));
  // 20.94 + sqrt(17.06^2 + 70.62^2) = 93.59, to the power 0.7: 23.98
  CHECK(between(red, blue) == doctest::Approx(0.96508).epsilon(1e-4).scale(0));
  // L* 50 and 60, which are ((L* + 16) / 116)^3 of white: 10^0.7 = 5.012; 0.95 · 5.012 / 16.51
  CHECK(between(one_colour(0.18419f, 0.18419f, 0.18419f), one_colour(0.28123f, 0.28123f, 0.28123f)) ==
        doctest::Approx(0.2884).epsilon(1e-3).scale(0));
}

TEST_CASE("FLIP: 0 for equal images, symmetric, never above 1") {
  const Picture a = picture(32, 24, changed_pattern), b = picture(32, 24, pattern);
  CHECK(highest(flip(a, a)) == 0);
  CHECK(flip(a, b) == flip(b, a));
  CHECK(highest(flip(one_colour(1, 1, 1), one_colour(0, 0, 0))) <= 1);
}

TEST_CASE("FLIP clips values to [0, 1], and takes what is not a number for black") {
  CHECK(highest(flip(one_colour(1, 1, 1), one_colour(9, 2, 1e30f))) == 0);
  Picture nan = one_colour(0, 0, 0);
  nan.rgb[5] = std::nanf("");
  nan.rgb[7] = -3;
  CHECK(highest(flip(nan, one_colour(0, 0, 0))) == 0);
}

TEST_CASE("FLIP works on pictures that are smaller than its filters") {
  const std::vector<float> map = flip(one_colour(1, 0, 0, 1), one_colour(0, 0, 1, 1));
  REQUIRE(map.size() == 1);
  CHECK(map[0] > 0.5f);
  CHECK(map[0] <= 1);
}

}  // namespace tyndall::test::flip_values_test
