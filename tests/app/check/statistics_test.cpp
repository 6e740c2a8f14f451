#include "app/check/statistics.h"

#include <doctest/doctest.h>

#include <random>

namespace tyndall::test::statistics_test {

namespace {

/// Samples of one pixel, grey.
std::vector<BookSample> grey(const std::vector<float>& values, int depth = 0) {
  std::vector<BookSample> samples;
  for (const float v : values) samples.push_back({{v, v, v}, depth});
  return samples;
}

/// A picture of `pixels` x `pixels` of one grey with noise, compared with the grey.
struct NoisyPicture {
  Lattice lattice{64, 64, 1};
  BlockGrid grid = grid_of(lattice);
  std::vector<float> light, expected, tolerance, variance;
  std::vector<char> left_out;
  NoisyPicture(unsigned seed, double noise) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0.3, noise);
    for (std::size_t k = 0; k < 3 * lattice.pixels(); ++k) {
      light.push_back(static_cast<float>(normal(random)));
      expected.push_back(0.3f), tolerance.push_back(0.004f), variance.push_back(0);
    }
    left_out.assign(lattice.pixels(), 0);
  }
  Misfit misfit() const { return misfit_of(block_differences({light, expected, tolerance, variance, left_out}, grid)); }
};

}  // namespace

TEST_CASE("check: statistics of samples are their mean, their variance, and what white cuts off of groups") {
  const auto samples = grey({0, 2, 0, 4});
  const SampleStatistics single = statistics_of(samples, 4, 1), pairs = statistics_of(samples, 4, 2);
  CHECK(single.mean[0] == doctest::Approx(1.5));
  CHECK(single.variance[1] == doctest::Approx(11.0 / 3));
  CHECK(single.excess[2] == doctest::Approx((1.0 + 3.0) / 4));
  CHECK(pairs.excess[0] == doctest::Approx((0.0 + 1.0) / 2));  // of the means 1 and 2
}

TEST_CASE("check: light that was found later than max_depth is left out") {
  auto samples = grey({1, 1}, 2);
  samples[1].depth = 5;
  CHECK(statistics_of(samples, 2, 1).mean[0] == doctest::Approx(1));
  CHECK(statistics_of(samples, 2, 1, 4).mean[0] == doctest::Approx(0.5));
  CHECK(statistics_of(samples, 2, 1, 1).mean[0] == 0.0f);
}

TEST_CASE("check: what is above white of a log-normal quantity agrees with a simulation") {
  std::mt19937 random(5);
  for (const auto& [mean, variance] : {std::pair{0.5, 0.2}, std::pair{0.9, 0.01}, std::pair{1.5, 1.0}}) {
    const double s2 = std::log1p(variance / (mean * mean));
    std::lognormal_distribution<double> drawn(std::log(mean) - s2 / 2, std::sqrt(s2));
    double sum = 0;
    constexpr int count = 1'000'000;
    for (int k = 0; k < count; ++k) sum += std::max(0.0, drawn(random) - 1);
    CHECK(lognormal_excess(mean, variance) == doctest::Approx(sum / count).epsilon(0.02));
  }
  CHECK(lognormal_excess(0, 0) == 0);
  CHECK(lognormal_excess(1.25, 0) == doctest::Approx(0.25));
  CHECK(lognormal_excess(0.5, 0) == 0);
}

TEST_CASE("check: noise makes no difference, a shift of one block does") {
  for (unsigned seed = 0; seed < 200; ++seed) CHECK(NoisyPicture(seed, 0.1).misfit().different == 0);
  NoisyPicture shifted(1, 0.02);
  for (std::size_t pixel = 0; pixel < shifted.left_out.size(); ++pixel)
    if (shifted.grid.block_of(pixel) == 10) shifted.light[3 * pixel + 1] += 0.03f;
  CHECK(shifted.misfit().different == 1);
  CHECK(shifted.misfit().amount > 0);
  for (std::size_t pixel = 0; pixel < shifted.left_out.size(); ++pixel)
    if (shifted.grid.block_of(pixel) == 10) shifted.left_out[pixel] = 1;
  CHECK(shifted.misfit().different == 0);
  CHECK(shifted.misfit().blocks == static_cast<int>(shifted.grid.count()) - 1);
}

TEST_CASE("check: without noise a difference of less than a step of 8 bits is none") {
  NoisyPicture flat(1, 0);
  for (float& value : flat.light) value += 0.003f;
  CHECK(flat.misfit().different == 0);
  for (float& value : flat.light) value += 0.003f;
  CHECK(flat.misfit().different == flat.misfit().blocks);
}

TEST_CASE("check: where no bright sample happened to be met, the error is that of the known variance") {
  NoisyPicture dark(1, 0);
  for (std::size_t k = 0; k < dark.light.size(); ++k) dark.expected[k] += 0.02f, dark.variance[k] = 0.04f;
  CHECK(dark.misfit().different == 0);
  for (float& value : dark.variance) value = 0;
  CHECK(dark.misfit().different == dark.misfit().blocks);
}

}  // namespace tyndall::test::statistics_test
