#include "core/accuracy/error.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace tyndall::test::flip_test {

namespace {

using Rgb = std::array<double, 3>;
constexpr int width = 23, height = 17;

std::vector<float> one_colour(float r, float g, float b, int w = width, int h = height) {
  std::vector<float> rgb;
  for (int i = 0; i < w * h; ++i) rgb.insert(rgb.end(), {r, g, b});
  return rgb;
}

std::vector<float> noise(unsigned seed) {
  std::mt19937 random(seed);
  std::vector<float> rgb;
  for (int i = 0; i < 3 * width * height; ++i) rgb.push_back(static_cast<float>(random() % 1300) / 1000);
  return rgb;
}

double mean(const std::vector<float>& map) {
  double sum = 0;
  for (const float v : map) sum += static_cast<double>(v);
  return sum / static_cast<double>(map.size());
}

// The paper once more, straight from its formulas: filters in two dimensions, one pixel at a time.
namespace slow {

constexpr double ppd = 67, pi = std::numbers::pi;
constexpr double to_xyz[3][3] = {
    {0.4124564, 0.3575761, 0.1804375}, {0.2126729, 0.7151522, 0.0721750}, {0.0193339, 0.1191920, 0.9503041}};
constexpr double from_xyz[3][3] = {
    {3.2404542, -1.5371385, -0.4985314}, {-0.9692660, 1.8760108, 0.0415560}, {0.0556434, -0.2040259, 1.0572252}};
constexpr Rgb white{0.95047, 1, 1.08883};

Rgb times(const double (&m)[3][3], Rgb v) {
  Rgb out{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) out[i] += m[i][j] * v[j];
  return out;
}

Rgb opponent(Rgb linear) {
  const Rgb c = times(to_xyz, linear);
  const double x = c[0] / white[0], y = c[1] / white[1], z = c[2] / white[2];
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

Rgb linear(Rgb o) {
  const double y = (o[0] + 16) / 116, x = o[1] / 500 + y, z = y - o[2] / 200;
  Rgb rgb = times(from_xyz, {x * white[0], y * white[1], z * white[2]});
  for (double& v : rgb) v = std::clamp(v, 0.0, 1.0);
  return rgb;
}

Rgb hunt_lab(Rgb rgb) {
  const Rgb c = times(to_xyz, rgb);
  Rgb f{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double t = c[i] / white[i], d = 6.0 / 29;
    f[i] = t > d * d * d ? std::cbrt(t) : t / (3 * d * d) + 4.0 / 29;
  }
  const double l = 116 * f[1] - 16;
  return {l, 0.01 * l * 500 * (f[0] - f[1]), 0.01 * l * 200 * (f[1] - f[2])};
}

double distance(Rgb a, Rgb b) {
  return std::pow(std::abs(a[0] - b[0]) + std::sqrt(std::pow(a[1] - b[1], 2) + std::pow(a[2] - b[2], 2)), 0.7);
}

Rgb pixel(const std::vector<float>& image, int x, int y) {
  Rgb rgb{};
  const int i = std::clamp(y, 0, height - 1) * width + std::clamp(x, 0, width - 1);
  for (std::size_t k = 0; k < 3; ++k)
    rgb[k] = std::clamp(static_cast<double>(image[static_cast<std::size_t>(3 * i) + k]), 0.0, 1.0);
  return opponent(rgb);
}

/// Sum of channel · weight(dx, dy) around a pixel; positive weights are scaled to 1, negative ones to -1.
template <class Weight>
double filtered(const std::vector<float>& image, int x, int y, std::size_t channel, int radius, Weight weight) {
  double positive = 0, negative = 0, plus = 0, minus = 0;
  for (int dy = -radius; dy <= radius; ++dy)
    for (int dx = -radius; dx <= radius; ++dx) {
      const double w = weight(dx, dy), value = pixel(image, x + dx, y + dy)[channel];
      (w > 0 ? positive : negative) += std::abs(w);
      (w > 0 ? plus : minus) += w * value;
    }
  return plus / positive + (negative > 0 ? minus / negative : 0);
}

Rgb colour_seen(const std::vector<float>& image, int x, int y) {
  const auto bell = [](double a1, double b1, double a2, double b2) {
    return [=](int dx, int dy) {
      const double d2 = (dx * dx + dy * dy) / (ppd * ppd);
      return a1 * std::sqrt(pi / b1) * std::exp(-pi * pi * d2 / b1) +
             a2 * std::sqrt(pi / b2) * std::exp(-pi * pi * d2 / b2);
    };
  };
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * pi * pi)) * ppd));
  return hunt_lab(linear({filtered(image, x, y, 0, radius, bell(1, 0.0047, 0, 1)),
                          filtered(image, x, y, 1, radius, bell(1, 0.0053, 0, 1)),
                          filtered(image, x, y, 2, radius, bell(34.1, 0.04, 13.5, 0.025))}));
}

double feature(const std::vector<float>& image, int x, int y, bool point) {
  const double s = 0.5 * 0.082 * ppd;
  const int radius = static_cast<int>(std::ceil(3 * s));
  const auto weight = [&](int along, int across) {
    const double bell = std::exp(-(along * along + across * across) / (2 * s * s));
    return point ? (along * along / (s * s) - 1) * bell : -along * bell;
  };
  const double h = filtered(image, x, y, 0, radius, [&](int dx, int dy) { return weight(dx, dy); });
  const double v = filtered(image, x, y, 0, radius, [&](int dx, int dy) { return weight(dy, dx); });
  return std::hypot(h, v) / 116;  // the shift by 16 falls out of a filter whose weights add up to 0
}

double flip(const std::vector<float>& a, const std::vector<float>& b, int x, int y) {
  const double largest = distance(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1})), knee = 0.4 * largest;
  const double d = distance(colour_seen(a, x, y), colour_seen(b, x, y));
  const double colour = d < knee ? 0.95 / knee * d : 0.95 + (d - knee) / (largest - knee) * 0.05;
  const double edge = std::abs(feature(a, x, y, false) - feature(b, x, y, false));
  const double point = std::abs(feature(a, x, y, true) - feature(b, x, y, true));
  return std::pow(colour, 1 - std::pow(std::max(edge, point) / std::sqrt(2.0), 0.5));
}

}  // namespace slow
}  // namespace

TEST_CASE("FLIP agrees with the paper's formulas, pixel by pixel") {
  const std::vector<float> a = noise(1), b = noise(2);
  const std::vector<float> map = flip_map(a, b, width, height);
  for (const auto& [x, y] : {std::pair{0, 0}, {11, 8}, {22, 16}, {3, 12}, {22, 0}})
    CHECK(map[static_cast<std::size_t>(y * width + x)] ==
          doctest::Approx(slow::flip(a, b, x, y)).epsilon(1e-5).scale(0));
}

TEST_CASE("FLIP: 0 for equal images, symmetric, never above 1") {
  const std::vector<float> a = noise(1), b = noise(2);
  CHECK(mean(flip_map(a, a, width, height)) == 0);
  CHECK(flip_map(a, b, width, height) == flip_map(b, a, width, height));
  const std::vector<float> far = flip_map(one_colour(1, 1, 1), one_colour(0, 0, 0), width, height);
  CHECK(*std::max_element(far.begin(), far.end()) <= 1);
  CHECK(mean(far) > 0.9);
}

TEST_CASE("FLIP: a difference that fills the picture is seen more than one that changes every pixel") {
  const std::vector<float> grey = one_colour(0.5f, 0.5f, 0.5f);
  std::vector<float> fine = grey;
  for (std::size_t i = 0; i < fine.size(); ++i) fine[i] += (i / 3 + i / 3 / width) % 2 ? 0.1f : -0.1f;
  CHECK(mean(flip_map(fine, grey, width, height)) < mean(flip_map(one_colour(0.6f, 0.6f, 0.6f), grey, width, height)));
}

TEST_CASE("FLIP clips values to [0, 1], and takes what is not a number for black") {
  const std::vector<float> white = one_colour(1, 1, 1), bright = one_colour(9, 2, 1e30f);
  CHECK(mean(flip_map(white, bright, width, height)) == 0);
  std::vector<float> nan = one_colour(0, 0, 0);
  nan[5] = std::nanf("");
  nan[7] = -3;
  CHECK(mean(flip_map(nan, one_colour(0, 0, 0), width, height)) == 0);
}

TEST_CASE("FLIP works on pictures that are smaller than its filters") {
  const std::vector<float> map = flip_map({1, 0, 0}, {0, 0, 1}, 1, 1);
  REQUIRE(map.size() == 1);
  CHECK(map[0] > 0.5f);
  CHECK(map[0] <= 1);
}

}  // namespace tyndall::test::flip_test
