#include "core/base/random.h"

#include <doctest/doctest.h>

#include <cmath>
#include <set>
#include <vector>

namespace tyndall::test::sobol_test {

namespace {

Sampler<float> point(std::uint32_t x, std::uint32_t y, std::uint32_t sample) {
  return Sampler<float>::of(3, x, y, sample, SamplerKind::sobol);
}

}  // namespace

TEST_CASE("sobol: the second dimension from reversed bits is that of the direction numbers") {
  // The direction numbers of the polynomial x + 1: v[0] = 2^31, v[k+1] = v[k] xor v[k] / 2.
  std::uint32_t v[32] = {0x80000000u};
  for (int k = 1; k < 32; ++k) v[k] = v[k - 1] ^ (v[k - 1] >> 1);
  for (std::uint32_t i = 1; i < 100000; i = i * 3 + 1) {
    std::uint32_t expected = 0;
    for (int k = 0; k < 32; ++k)
      if (i >> k & 1) expected ^= v[k];
    CHECK(sobol_second(reverse_bits(i)) == expected);
  }
}

TEST_CASE("sobol: the points of each half fill every elementary interval of 2^k points") {
  for (const std::uint32_t half : {0u, 1u})
    for (const std::uint32_t dims : {dimension::pixel, dimension::direction, dimension::light_point})
      for (int log = 1; log <= 8; ++log)
        for (int split = 0; split <= log; ++split) {
          std::set<int> cells;
          for (std::uint32_t i = 0; i < 1u << log; ++i) {
            const Pair<float> p = point(17, 5, 2 * i + half).next_2d(dims);
            const int across = static_cast<int>(p.x * static_cast<float>(1 << split));
            const int up = static_cast<int>(p.y * static_cast<float>(1 << (log - split)));
            cells.insert(across + (up << split));
          }
          CHECK(cells.size() == std::size_t{1} << log);
        }
}

TEST_CASE("sobol: single dimensions are stratified, and halves, pixels and dimensions are independent") {
  const int n = 64;
  std::set<int> strata;
  for (std::uint32_t i = 0; i < n; ++i)
    strata.insert(static_cast<int>(point(1, 2, 2 * i).next_1d(dimension::lobe) * n));
  CHECK(strata.size() == n);
  // Products of centred numbers, averaged over many pixels: variance 1/144.
  const int pixels = 20000;
  double halves = 0, neighbours = 0, dimensions = 0, pairs = 0;
  for (std::uint32_t k = 0; k < pixels; ++k) {
    const Sampler<float> a = point(k, 9, 6), b = point(k, 9, 7), c = point(k + 1, 9, 6);
    const auto centred = [](float u) { return static_cast<double>(u) - 0.5; };
    halves += centred(a.next_1d(1)) * centred(b.next_1d(1));
    neighbours += centred(a.next_1d(1)) * centred(c.next_1d(1));
    dimensions += centred(a.next_1d(1)) * centred(a.next_1d(4));
    pairs += centred(a.next_2d(2).x) * centred(a.next_2d(6).y);
  }
  const double limit = 4 * std::sqrt(pixels / 144.0);
  for (const double sum : {halves, neighbours, dimensions, pairs}) CHECK(std::abs(sum) < limit);
}

TEST_CASE("sobol: in 64 samples of a pixel, dimensions used together hardly correlate, others as random ones do") {
  // For comparison: with 64 samples, Halton's bases 107 and 109 correlate fully, plain Sobol' dimensions by up to
  // 0.997.
  const std::uint32_t pairs[] = {dimension::pixel, dimension::lens, dimension::camera_count + dimension::direction,
                                 dimension::camera_count + dimension::light_point};
  constexpr int samples = 64, pixels = 500;
  double within = 0, between = 0, sum = 0, count = 0;
  for (std::uint32_t pixel = 0; pixel < pixels; ++pixel) {
    double number[8][samples];
    for (std::uint32_t i = 0; i < samples; ++i)
      for (int k = 0; k < 4; ++k) {
        const Pair<float> p = point(pixel, 11, i).next_2d(pairs[k]);
        number[2 * k][i] = static_cast<double>(p.x) - 0.5, number[2 * k + 1][i] = static_cast<double>(p.y) - 0.5;
      }
    const auto correlation = [&](int a, int b) {
      double ab = 0, aa = 0, bb = 0;
      for (int i = 0; i < samples; ++i)
        ab += number[a][i] * number[b][i], aa += number[a][i] * number[a][i], bb += number[b][i] * number[b][i];
      return ab / std::sqrt(aa * bb);
    };
    for (int a = 0; a < 8; ++a)
      for (int b = a + 1; b < 8; ++b) {
        if (a / 2 == b / 2) {
          within = std::max(within, std::abs(correlation(a, b)));
          continue;
        }
        const double c = correlation(a, b);
        between += c * c, sum += c, ++count;
      }
  }
  CHECK(within < 0.2);
  // Independent numbers: 1 / sqrt(samples). Each two successive points of a half share a stratum, which leaves at least
  // half as many that are independent.
  CHECK(std::sqrt(between / count) < 1 / std::sqrt(samples / 2.0));
  CHECK(std::abs(sum / count) < 4 / std::sqrt(samples * count / 2.0));
}

TEST_CASE("sobol: numbers are uniform over pixels for any one sample") {
  const int pixels = 100000, bins = 64;
  for (const std::uint32_t sample : {0u, 1u, 37u}) {
    std::vector<int> count(bins);
    for (std::uint32_t k = 0; k < pixels; ++k)
      ++count[static_cast<std::size_t>(point(k % 317, k / 317, sample).next_2d(2).y * bins)];
    double chi2 = 0;
    for (const int c : count) chi2 += std::pow(c - pixels / bins, 2) / (pixels / bins);
    CHECK(chi2 < bins - 1 + 4 * std::sqrt(2.0 * (bins - 1)));
  }
}

}  // namespace tyndall::test::sobol_test
