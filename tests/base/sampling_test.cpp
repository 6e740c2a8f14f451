#include "core/base/sampling.h"

#include "tests/support/statistics.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace tyndall::test::sampling_test {

namespace {

constexpr int count = 400000;
constexpr float largest = 1.0f - 0x1p-24f;
constexpr float edges[] = {0.0f, 0x1p-24f, 0.25f, 0.5f, 0.75f, largest};

Pair<float> numbers(int i) {
  return Sampler<float>::of(3, static_cast<std::uint32_t>(i), 0, 0).next_2d(dimension::direction);
}

/// Bin of v in [low, high) out of n.
std::size_t bin(double v, double low, double high, int n) {
  return static_cast<std::size_t>(std::clamp(static_cast<int>((v - low) / (high - low) * n), 0, n - 1));
}

}  // namespace

TEST_CASE("on_sphere: moments of the uniform sphere") {
  double first[3] = {}, second[3][3] = {}, fourth = 0;
  for (int i = 0; i < count; ++i) {
    const Vec3f v = on_sphere(numbers(i));
    const double c[3] = {v.x, v.y, v.z};
    for (int a = 0; a < 3; ++a) {
      first[a] += c[a] / count;
      for (int b = 0; b < 3; ++b) second[a][b] += c[a] * c[b] / count;
    }
    fourth += c[2] * c[2] * c[2] * c[2] / count;
  }
  const double sigma = std::sqrt(1.0 / 3 / count);
  for (int a = 0; a < 3; ++a) {
    CHECK(std::abs(first[a]) < 4 * sigma);
    for (int b = 0; b < 3; ++b) CHECK(std::abs(second[a][b] - (a == b ? 1.0 / 3 : 0)) < 4 * 0.3 / std::sqrt(count));
  }
  CHECK(std::abs(fourth - 0.2) < 4 * std::sqrt(1.0 / 9 - 0.04) / std::sqrt(count));
}

TEST_CASE("on_sphere: equal areas of sphere are hit equally, about every axis") {
  std::array<std::vector<int>, 3> bins;
  bins.fill(std::vector<int>(32 * 32));
  for (int i = 0; i < count; ++i) {
    const Vec3f v = on_sphere(numbers(i));
    const double c[5] = {v.x, v.y, v.z, v.x, v.y};
    for (std::size_t a = 0; a < 3; ++a)
      ++bins[a][bin(c[a], -1, 1, 32) * 32 + bin(std::atan2(c[a + 2], c[a + 1]), -pi, pi, 32)];
  }
  for (const auto& b : bins) CHECK(std::abs(chi_square_deviate(b)) < 4);
}

TEST_CASE("on_sphere, in_disc: unit, bounded and a number for every input, the ends included") {
  for (const float x : edges)
    for (const float y : edges) {
      CAPTURE(x);
      CAPTURE(y);
      CHECK(std::abs(length(on_sphere<float>({x, y})) - 1) < 1e-6f);
      const Pair<float> p = in_disc<float>({x, y});
      CHECK(std::abs(std::hypot(p.x, p.y) - std::sqrt(x)) < 1e-6f);
      CHECK(p.x * p.x + p.y * p.y < 1 + 1e-6f);
    }
  for (int i = 0; i < count; ++i) {
    const float size = length(on_sphere(numbers(i)));
    if (!(std::abs(size - 1) < 1e-6f)) CHECK_MESSAGE(false, size);
  }
}

TEST_CASE("in_disc: equal areas are hit equally, mean 0, mean square 1/4 per axis") {
  std::vector<int> bins(32 * 32);
  double x = 0, y = 0, xx = 0, yy = 0, xy = 0;
  for (int i = 0; i < count; ++i) {
    const Pair<float> p = in_disc(numbers(i));
    const double a = p.x, b = p.y;
    ++bins[bin(a * a + b * b, 0, 1, 32) * 32 + bin(std::atan2(b, a), -pi, pi, 32)];
    x += a / count, y += b / count, xx += a * a / count, yy += b * b / count, xy += a * b / count;
  }
  CHECK(std::abs(chi_square_deviate(bins)) < 4);
  const double sigma = 0.5 / std::sqrt(count);
  CHECK(std::abs(x) < 4 * sigma);
  CHECK(std::abs(y) < 4 * sigma);
  CHECK(std::abs(xx - 0.25) < 4 * 0.25 / std::sqrt(count));
  CHECK(std::abs(yy - 0.25) < 4 * 0.25 / std::sqrt(count));
  CHECK(std::abs(xy) < 4 * 0.25 / std::sqrt(count));
}

TEST_CASE("around: unit, with the given cosine to the axis, for every axis") {
  std::mt19937 engine(1);
  std::normal_distribution<float> normal;
  for (int i = 0; i < 2000; ++i) {
    Vec3f axis = normalize(Vec3f{normal(engine), normal(engine), normal(engine)});
    if (i < 6) axis = {i / 2 == 0 ? 1.0f : 0.0f, i / 2 == 1 ? 1.0f : 0.0f, i / 2 == 2 ? 1.0f : 0.0f};
    if (i < 6 && i % 2) axis = -axis;
    for (const float cosine : {-1.0f, -0.99999994f, -0.3f, 0.0f, 0.5f, 0.99999994f, 1.0f})
      for (const float u : edges) {
        const Vec3f v = around(axis, cosine, u);
        if (std::abs(length(v) - 1) < 1e-6f && std::abs(dot(v, axis) - cosine) < 1e-6f) continue;
        CHECK_MESSAGE(false, axis.x << ' ' << axis.y << ' ' << axis.z << ' ' << cosine << ' ' << u);
      }
  }
}

TEST_CASE("around: all turns about the axis are equally likely") {
  const Vec3f axis = normalize(Vec3f{0.3f, -0.5f, -0.8f});
  // Any two directions at right angles to the axis and to each other will do.
  const Vec3f s = normalize(cross(axis, Vec3f{0, 1, 0})), t = cross(axis, s);
  std::vector<int> bins(64);
  for (int i = 0; i < count; ++i) {
    const Vec3f v = around(axis, 0.7f, numbers(i).y);
    ++bins[bin(std::atan2(dot(v, t), dot(v, s)), -pi, pi, 64)];
  }
  CHECK(std::abs(chi_square_deviate(bins)) < 4);
}

TEST_CASE("reservoir: things are taken in proportion to their weights, by one random number") {
  constexpr std::array<float, 6> weights{0, 3, 0, 1, 4, 0};
  constexpr int draws = 80'000;
  std::array<int, 6> taken{};
  for (int i = 0; i < draws; ++i) {
    Reservoir<float> reservoir{(static_cast<float>(i) + 0.5f) / draws};
    std::size_t last = 0;
    for (std::size_t k = 0; k < weights.size(); ++k)
      if (reservoir.offer(weights[k])) last = k;
    CHECK(reservoir.weight == 8);
    ++taken[last];
  }
  for (std::size_t k = 0; k < weights.size(); ++k)
    CHECK(std::abs(static_cast<float>(taken[k]) - weights[k] / 8 * draws) <= 20);
}

TEST_CASE("reservoir: nothing is taken where all weights are 0") {
  Reservoir<float> reservoir{0.5f};
  CHECK(!reservoir.offer(0));
  CHECK(!reservoir.offer(0));
  CHECK(reservoir.weight == 0);
  CHECK(reservoir.pick == 0.5f);
}

}  // namespace tyndall::test::sampling_test
