#include "core/base/random.h"
#include "core/base/math.h"
#include "tests/support/statistics.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

namespace tyndall::test::random_test {

namespace {

using FloatSampler = Sampler<float>;

struct Key {
  std::uint32_t seed, x, y, sample;
};
FloatSampler sampler_of(Key k, bool sobol = false) {
  return FloatSampler::of(k.seed, k.x, k.y, k.sample, sobol ? SamplerKind::sobol : SamplerKind::random);
}

constexpr std::uint32_t edge = 256;
constexpr int dimensions = 8;

/// By what one set of samples differs from another of which it should be independent.
struct Shift {
  std::uint32_t seed = 0, sample = 0, dx = 0, dy = 0;
  int events = 0;
};

/// The first dimensions of a sample of every pixel of a square, those of the event `events` steps later.
std::vector<std::array<double, dimensions>> numbers(const Shift& by, bool sobol) {
  std::vector<std::array<double, dimensions>> all;
  for (std::uint32_t y = 0; y < edge; ++y)
    for (std::uint32_t x = 0; x < edge; ++x) {
      FloatSampler sampler = sampler_of({5 + by.seed, x + by.dx, y + by.dy, by.sample}, sobol);
      for (int e = 0; e < by.events; ++e) sampler.next_event();
      auto& row = all.emplace_back();
      for (std::uint32_t d = 0; d < dimensions; d += 2) {
        const Pair<float> pair = sampler.next_2d(d);
        row[d] = static_cast<double>(pair.x) - 0.5, row[d + 1] = static_cast<double>(pair.y) - 0.5;
      }
    }
  return all;
}

/// Largest correlation of any dimension of a with any dimension of b. same: a and b are one set, so that a dimension is
/// not compared with itself.
double largest_correlation(const std::vector<std::array<double, dimensions>>& a,
                           const std::vector<std::array<double, dimensions>>& b, bool same = false) {
  double maximum = 0;
  for (std::size_t i = 0; i < dimensions; ++i)
    for (std::size_t j = 0; j < dimensions; ++j) {
      if (same && i == j) continue;
      double sum = 0;
      for (std::size_t k = 0; k < a.size(); ++k) sum += a[k][i] * b[k][j];
      maximum = std::max(maximum, std::abs(sum / (static_cast<double>(a.size()) / 12)));
    }
  return maximum;
}

}  // namespace

TEST_CASE("dice: dimensions, neighbouring pixels, samples, events and seeds are uncorrelated") {
  for (const bool sobol : {false, true}) {
    const auto base = numbers({}, sobol);
    const double limit = 4 / std::sqrt(static_cast<double>(base.size()));
    CAPTURE(sobol);
    CHECK(largest_correlation(base, base, true) < limit);
    // Sample 1 is in the other half of the film. Samples of the same half are stratified together, so not independent.
    const Shift shifts[] = {{.dx = 1},   {.dy = 1},     {.dx = 1, .dy = 1},   {.sample = 1},
                            {.seed = 1}, {.events = 1}, {.seed = 1, .dx = 1}, {.sample = 1, .dx = 1}};
    for (const Shift& by : shifts) CHECK(largest_correlation(base, numbers(by, sobol)) < limit);
    if (!sobol) CHECK(largest_correlation(base, numbers({.sample = 2}, sobol)) < limit);
  }
}

TEST_CASE("dice: no two samples share a stream, whatever the pixel, sample index or seed") {
  std::set<std::pair<std::uint32_t, std::uint32_t>> streams;
  std::size_t count = 0;
  for (const std::uint32_t seed : {0u, 1u, 2u, 3u, 64u, 0x80000000u, 0xffffffffu})
    for (std::uint32_t y = 0; y < 32; ++y)
      for (std::uint32_t x = 0; x < 32; ++x)
        for (std::uint32_t sample = 0; sample < 16; ++sample, ++count) {
          const FloatSampler sampler = sampler_of({seed, x, y, sample});
          streams.insert({sampler.low, sampler.high});
        }
  CHECK(streams.size() == count);
}

TEST_CASE("dice: the mean over a picture scatters from seed to seed as independent runs do") {
  // 64 pictures of 64 x 64: a seed that only exchanged pixels would give the same mean again.
  constexpr int runs = 64, pixels = 64 * 64;
  double sum = 0, squares = 0;
  for (std::uint32_t seed = 0; seed < runs; ++seed) {
    double mean = 0;
    for (std::uint32_t i = 0; i < pixels; ++i)
      mean += static_cast<double>(sampler_of({seed, i % 64, i / 64, 0}).next_1d(dimension::lobe)) / pixels;
    sum += mean, squares += mean * mean;
  }
  const double variance = (squares - sum * sum / runs) / (runs - 1), expected = 1.0 / 12 / pixels;
  CHECK(std::abs(variance / expected - 1) < 4 * std::sqrt(2.0 / (runs - 1)));
  CHECK(std::abs(sum / runs - 0.5) < 4 * std::sqrt(expected / runs));
}

TEST_CASE("dice: every dimension is uniform over a picture, alone and in pairs") {
  for (std::uint32_t k = 0; k < 4 * dimension::per_event; ++k) {
    const std::uint32_t d = k / 2;
    std::vector<int> bins(256), squares(256);
    for (std::uint32_t i = 0; i < 65536; ++i) {
      FloatSampler sampler = sampler_of({9, i % 256, i / 256, d % 5}, k % 2 == 1);
      const Pair<float> u = sampler.next_2d(d);
      ++bins[static_cast<std::size_t>(u.x * 256)];
      ++squares[static_cast<std::size_t>(u.x * 16) * 16 + static_cast<std::size_t>(u.y * 16)];
    }
    CAPTURE(k);
    CHECK(std::abs(chi_square_deviate(bins)) < 4);
    CHECK(std::abs(chi_square_deviate(squares)) < 4);
  }
}

TEST_CASE("dice: every bit of a word is set half of the time, whichever coordinate runs") {
  constexpr int count = 1 << 16;
  for (int which = 0; which < 4; ++which)
    for (std::uint32_t d = 0; d < 4; ++d) {
      std::array<int, 32> set{};
      for (std::uint32_t i = 0; i < count; ++i) {
        const Key keys[4] = {{i, 3, 4, 5}, {7, i, 4, 5}, {7, 3, i, 5}, {7, 3, 4, i}};
        const std::uint32_t random_bits = sampler_of(keys[which]).random_bits(d);
        for (std::size_t b = 0; b < 32; ++b) set[b] += static_cast<int>(random_bits >> b & 1u);
      }
      for (const int n : set) CHECK(std::abs(n - count / 2) < 4.5 * std::sqrt(count / 4.0));
    }
}

TEST_CASE("dice: the numbers of a sample are the same whenever they are asked for") {
  const FloatSampler a = sampler_of({1, 2, 3, 4});
  FloatSampler b = sampler_of({1, 2, 3, 4});
  CHECK(a.random_bits(3) == b.random_bits(3));
  CHECK(b.next_2d(2).y == b.next_1d(3));
  b.next_event();
  CHECK(a.random_bits(dimension::per_event + 3) == b.random_bits(3));  // events follow each other in one table
  CHECK(a.open(0, 0) != a.open(0, 1));  // media that share an event have their own numbers
}

TEST_CASE("numbers from bits: [0, 1) and (0, 1], to the last bit") {
  CHECK(unit_interval<float>(0u) == 0.0f);
  CHECK(unit_interval<float>(0xffffffffu) == 1.0f - 0x1p-24f);
  CHECK(unit_interval<float>(0x80000000u) == 0.5f);
  CHECK(unit_interval_open<float>(0u) == 0x1p-32f);
  CHECK(unit_interval_open<float>(0xffffffffu) == 1.0f);
  CHECK(-tyndall::log(unit_interval_open<float>(0xffffffffu)) == 0.0f);
  CHECK(-tyndall::log(unit_interval_open<float>(0u)) == doctest::Approx(32 * std::log(2.0)));
  for (std::uint32_t i = 0; i < 10000; ++i) {
    const std::uint32_t h = i * 429496u + 7;
    CHECK(std::abs(static_cast<double>(unit_interval<float>(h)) - h * 0x1p-32) <= 0x1p-24);
    CHECK(std::abs(static_cast<double>(unit_interval_open<float>(h)) / (h * 0x1p-32) - 1) <= 1.0 / h + 0x1p-23);
  }
}

TEST_CASE("hash: an input bit moves every output bit half of the time") {
  constexpr int count = 20000;
  for (std::uint32_t in = 0; in < 32; ++in) {
    std::array<int, 32> moved{};
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t x = i * golden_ratio;
      const std::uint32_t change = hash(x) ^ hash(x ^ (1u << in));
      for (std::size_t b = 0; b < 32; ++b) moved[b] += static_cast<int>(change >> b & 1u);
    }
    for (const int n : moved) CHECK(std::abs(n / double{count} - 0.5) < 0.05);
  }
}

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

}  // namespace tyndall::test::random_test
