#include "app/check/statistics.h"

#include <doctest/doctest.h>

#include <limits>
#include <random>

namespace tyndall::test::statistics_test {

namespace {

/// Samples of one pixel, grey.
std::vector<BookSample> grey(const std::vector<float>& values) {
  std::vector<BookSample> samples;
  for (const float v : values) samples.push_back({{v, v, v}, 0});
  return samples;
}

/// A picture of `pixels` x `pixels` of one grey with noise, compared with the grey.
struct NoisyPicture {
  Lattice lattice{64, 64, 1};
  Regions regions = blocks_of(lattice, edge_of_blocks(lattice));
  ReadPixels picture;
  ExpectedPixels expected;
  NoisyPicture(unsigned seed, double noise) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0.3, noise);
    for (std::size_t k = 0; k < 3 * lattice.pixels(); ++k) {
      picture.light.push_back(normal(random)), picture.tolerance.push_back(0.004);
      expected.light.push_back(0.3), expected.variance.push_back(0);
    }
  }
  std::vector<CellDifference> differences() const { return differences_of(picture, expected, regions); }
  Misfit misfit() const { return misfit_of(differences()); }
};

}  // namespace

TEST_CASE("check: statistics of samples are their mean, their variance, and what white cuts off of groups") {
  const auto samples = grey({0, 2, 0, 4});
  const SampleStatistics single = statistics_of(samples, 4, {1})[0], pairs = statistics_of(samples, 4, {2})[2];
  CHECK(single.mean == doctest::Approx(1.5));
  CHECK(single.variance == doctest::Approx(11.0 / 3));
  CHECK(single.excess == doctest::Approx((1.0 + 3.0) / 4));
  CHECK(pairs.excess == doctest::Approx((0.0 + 1.0) / 2));  // of the means 1 and 2
  CHECK(single.noise == doctest::Approx(1.0 / 3));          // of 0, 1, 0, 1
  CHECK(single.common == doctest::Approx(1.0));             // of these with 0, 2, 0, 4
  CHECK(pairs.noise == 0);                                  // both are white
  const SampleStatistics light = statistics_of(samples, 4, {2, std::numeric_limits<double>::infinity()})[0];
  CHECK(light.excess == 0);
  CHECK(light.noise == doctest::Approx(0.5));  // of 1 and 2
}

TEST_CASE("check: what white cuts off of many samples is found from the samples of neighbours") {
  std::mt19937 random(5);
  std::bernoulli_distribution hit(0.05);
  constexpr int count = 16, pixels = 4000;
  std::vector<BookSample> samples;
  for (int k = 0; k < count * pixels; ++k) samples.push_back({hit(random) ? Vec3f{10, 10, 10} : Vec3f{}, 0});
  const Regions one{std::vector<int>(pixels, 0), 1};
  double few = 0, many = 0;
  constexpr int trials = 100000, of_many = 128;
  std::binomial_distribution<int> hits_of_few(count, 0.05), hits_of_many(of_many, 0.05);
  for (int k = 0; k < trials; ++k) {
    few += std::max(0.0, hits_of_few(random) * 10.0 / count - 1);
    many += std::max(0.0, hits_of_many(random) * 10.0 / of_many - 1);
  }
  CHECK(excess_ratios(samples, count, of_many, one)[0] == doctest::Approx(many / few).epsilon(0.15));
}

TEST_CASE("check: noise makes no difference, a shift of one block does") {
  for (unsigned seed = 0; seed < 200; ++seed) CHECK(NoisyPicture(seed, 0.1).misfit().different == 0);
  NoisyPicture shifted(1, 0.02);
  for (std::size_t pixel = 0; pixel < shifted.lattice.pixels(); ++pixel)
    if (shifted.regions.of_pixel[pixel] == 10) shifted.picture.light[3 * pixel + 1] += 0.03;
  CHECK(shifted.misfit().different == 1);
  CHECK(amount_of(shifted.differences(), shifted.differences()) > 0);
  for (int& region : shifted.regions.of_pixel)
    if (region == 10) region = -1;
  CHECK(shifted.misfit().different == 0);
  CHECK(shifted.misfit().blocks == shifted.regions.count - 1);
}

TEST_CASE("check: without noise a difference of less than a step of 8 bits is none") {
  NoisyPicture flat(1, 0);
  for (double& value : flat.picture.light) value += 0.003;
  CHECK(flat.misfit().different == 0);
  for (double& value : flat.picture.light) value += 0.003;
  CHECK(flat.misfit().different == flat.misfit().blocks);
}

TEST_CASE("check: where no bright sample happened to be met, the error is that of the known variance") {
  NoisyPicture dark(1, 0);
  for (double& value : dark.expected.light) value += 0.02;
  std::fill(dark.expected.variance.begin(), dark.expected.variance.end(), 0.04);
  CHECK(dark.misfit().different == 0);
  std::fill(dark.expected.variance.begin(), dark.expected.variance.end(), 0);
  CHECK(dark.misfit().different == dark.misfit().blocks);
}

TEST_CASE("check: the fraction of light that has come up to each depth") {
  CHECK(light_by_depth({{{1, 1, 1}, 0}, {{1, 1, 1}, 2}}) == Numbers{0.5, 0.5, 1});
}

TEST_CASE("check: a picture's numbers as each way of reading takes them") {
  PictureNumbers picture{2, 1, {0.5f, 1, 0.25f, 0, 0.75f, 1}};
  const auto light = [&](const Reading& reading) { return read_pixels(picture, {2, 1}, reading).light; };
  CHECK(light({TransferCurve::light}) == Numbers{0.5, 1, 0.25, 0, 0.75, 1});
  CHECK(light({TransferCurve::light, false, true}) == Numbers{0, 0.75, 1, 0.5, 1, 0.25});
  CHECK(light({TransferCurve::light, false, false, true}) == Numbers{0.25, 1, 0.5, 1, 0.75, 0});
  CHECK(light({TransferCurve::gamma2}) == Numbers{0.25, 1, 0.0625, 0, 0.5625, 1});
}

}  // namespace tyndall::test::statistics_test
