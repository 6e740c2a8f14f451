#include "core/accuracy/error.h"
#include "tests/support/capture.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>

// FLIP against numbers that do not come from this project's reading of the paper: what the authors' own program says,
// and what can be worked out with pen and paper from published colours and from the integrals of the filters.

namespace tyndall::test::error_test {

TEST_CASE("film mean: by hand for two pixels that show different things") {
  Film film = make_film(2, 1, {0, 0, 2, 1}, 0, 8);
  const auto add = [&](int x, std::uint32_t half, float red) {
    add_sample(film.at(x, 0), half, {red, 2, 3}, 1 / film.quantum);
    ++film.at(x, 0).taken;
  };
  add(0, 0, 1), add(0, 1, 4), add(1, 0, 7);
  CHECK(film_mean(film).error == std::numeric_limits<double>::infinity());
  add(1, 1, 7);
  CHECK(film_mean(film).mean == doctest::Approx((2.5 + 7 + 2 + 2 + 3 + 3) / 6));
  CHECK(film_mean(film).error ==
        doctest::Approx(0.5 * std::sqrt(0.25)));  // halves 2 and 3 in one pixel, alike in the other
}

TEST_CASE("image error: is what was computed by hand") {
  const ImageError error = image_error({0.2f, 0.5f, 1.0f}, {0.1f, 0.5f, 0.5f});
  CHECK(error.mse == doctest::Approx((0.01 + 0.25) / 3).epsilon(1e-6).scale(0));
  CHECK(error.rmse == doctest::Approx(0.294392).epsilon(1e-5).scale(0));
  CHECK(error.rel_mse == doctest::Approx((0.01 / 0.02 + 0.25 / 0.26) / 3).epsilon(1e-6).scale(0));
  // sRGB: 0.484529 - 0.349190 and 1 - 0.735357.
  CHECK(error.psnr ==
        doctest::Approx(-10 * std::log10((0.135339 * 0.135339 + 0.264643 * 0.264643) / 3)).epsilon(1e-5).scale(0));
  CHECK(error.mean_image.x == doctest::Approx(0.2));
  CHECK(error.mean_reference.z == doctest::Approx(0.5));
}

TEST_CASE("image error: means run over all pixels, channel by channel") {
  const ImageError error = image_error({1, 2, 3, 3, 4, 7}, {1, 2, 3, 3, 4, 5});
  CHECK(error.mean_image == Vec3d{2, 3, 5});
  CHECK(error.mean_reference == Vec3d{2, 3, 4});
  CHECK(error.mse == doctest::Approx(4.0 / 6));
  CHECK(error.psnr == std::numeric_limits<double>::infinity());  // the same when clipped to [0, 1]
  CHECK(image_error({-3, 0, 0}, {0, -1, 0}).psnr == std::numeric_limits<double>::infinity());
}

TEST_CASE("image error: of equal images it is 0, and what is not a number is not hidden") {
  const std::vector<float> image = {0.1f, 0.2f, 0.3f};
  CHECK(image_error(image, image).mse == 0);
  CHECK(image_error(image, image).psnr == std::numeric_limits<double>::infinity());
  const ImageError bad = image_error({std::numeric_limits<float>::quiet_NaN(), 0, 0}, image);
  CHECK(std::isnan(bad.mse));
  CHECK(std::isnan(bad.psnr));
}

TEST_CASE("relMSE alone is that of all the errors") {
  std::vector<float> image, reference;
  for (int i = 0; i < 300; ++i) {
    image.push_back(0.01f * static_cast<float>(i % 37));
    reference.push_back(0.02f * static_cast<float>(i % 11));
  }
  CHECK(relative_mse(image, reference) == image_error(image, reference).rel_mse);
  CHECK(relative_mse(image, image) == 0);
}

TEST_CASE("the error of each pixel against a reference: by the reference's size, spread over 7 x 7") {
  constexpr int columns = 20, rows = 15;
  constexpr auto at = [](int x, int y) { return static_cast<std::size_t>(3 * (y * columns + x)); };
  std::vector<float> reference(3 * columns * rows, 1.0f), image = reference;
  for (std::size_t k = 0; k < 3; ++k) image[at(10, 7) + k] = 1.5f;
  const std::vector<float> errors = pixel_relative_error(image, reference, columns, rows);
  REQUIRE(errors.size() == columns * rows);
  const double peak = std::sqrt(0.25 / 1.01 / 49);
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      const bool near = std::abs(x - 10) <= 3 && std::abs(y - 7) <= 3;
      CHECK(errors[at(x, y) / 3] == doctest::Approx(near ? peak : 0.0));
    }
}

TEST_CASE("error outside [0, 1]: only of values that one of both has there, in both directions") {
  const OutsideError error = outside_error({0.2f, 3.0f, 1.0f, -0.5f, 0.0f, 1.0f}, {0.9f, 2.0f, 1.5f, 0.0f, 1.0f, 1.0f});
  CHECK(error.values == 3);
  CHECK(error.rel_mse == doctest::Approx((1 / 4.01 + 0.25 / 2.26 + 0.25 / 0.01) / 3).epsilon(1e-6).scale(0));
  CHECK(outside_error({0, 0.5f, 1}, {1, 0, 0}).values == 0);
  CHECK(outside_error({0, 0.5f, 1}, {1, 0, 0}).rel_mse == 0);
  const float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  CHECK(outside_error({nan, infinity, 2}, {3, infinity, 2}).values == 1);
}

TEST_CASE("not finite: how many pixels, and the first of them with its value") {
  const float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  LinearImage image{3, 2, std::vector<float>(18, 0.5f)};
  CHECK(not_finite_text(image).empty());
  CHECK(is_finite(image, 5));
  image.rgb[3 * 5 + 2] = -infinity;
  CHECK(not_finite_text(image) == "1 of 6 pixels is not finite, the first at 2,1 (blue is -inf)");
  CHECK_FALSE(is_finite(image, 5));
  image.rgb[3 * 1 + 1] = nan, image.rgb[3 * 1 + 2] = nan;  // one pixel, whatever its channels
  CHECK(not_finite_text(image) == "2 of 6 pixels are not finite, the first at 1,0 (green is nan)");
  image.frame = ImageFrame{{0, 0, 9, 9}, {4, -3, 7, -1}};  // an EXR's data window: the place is the picture's
  CHECK(not_finite_text(image) == "2 of 6 pixels are not finite, the first at 5,-3 (green is nan)");
}

namespace {

constexpr int edge = 128;

/// Exponential noise around a ramp, times `factor` in the right half.
Film noisy_film(unsigned seed, float factor) {
  Film film = make_film(edge, edge, {0, 0, edge, edge}, 0, 64);
  std::mt19937 engine(seed);
  std::exponential_distribution<float> noise;
  for (int i = 0; i < edge * edge; ++i) {
    FilmPixel& pixel = film.pixels[static_cast<std::size_t>(i)];
    const float truth = (1 + static_cast<float>(i % edge)) * (i % edge < edge / 2 ? 1.0f : factor) / edge;
    for (std::uint32_t s = 0; s < 16; ++s) {
      const float v = truth * noise(engine);
      add_sample(pixel, s & 1, {v, v, v}, 1 / film.quantum);
    }
    pixel.taken = 16;
  }
  return film;
}

}  // namespace

TEST_CASE("block scores: films that differ by noise alone pass, ten percent more in half of the picture fails") {
  const Film plain = noisy_film(1, 1);
  for (unsigned seed = 2; seed < 6; ++seed) {
    const BlockScores same = block_scores(plain, noisy_film(seed, 1));
    CHECK(same.blocks == 64);
    CHECK(same.mean_square > 0.4);
    CHECK(same.noise());
  }
  const BlockScores biased = block_scores(noisy_film(1, 1), noisy_film(2, 1.1f));
  CHECK_FALSE(biased.noise());
  CHECK(biased.mean_square > 2);
}

TEST_CASE("block scores: films that are equal, of other regions, with empty halves, or different without noise") {
  const Film film = noisy_film(1, 1);
  CHECK(block_scores(film, film).mean_square == 0);
  CHECK(block_scores(film, film).noise());
  Film part = make_film(edge, edge, {0, 0, edge, edge / 2}, 0, 64);
  CHECK(block_scores(film, part).blocks == 0);
  CHECK(block_scores(film, make_film(edge, edge, film.region, 0, 64)).blocks == 0);
  Film flat = make_film(8, 8, {0, 0, 8, 8}, 0, 64), brighter = flat;
  for (std::size_t i = 0; i < 64; ++i)
    for (std::uint32_t s = 0; s < 2; ++s) {
      add_sample(flat.pixels[i], s, {1, 1, 1}, 1 / flat.quantum), ++flat.pixels[i].taken;
      add_sample(brighter.pixels[i], s, {1.5f, 1.5f, 1.5f}, 1 / flat.quantum), ++brighter.pixels[i].taken;
    }
  CHECK(block_scores(flat, flat).noise());
  CHECK_FALSE(block_scores(flat, brighter).noise());
}

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

}  // namespace tyndall::test::error_test
