#include "app/check/statistics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace tyndall {
namespace {

constexpr std::size_t min_ratios = 8;  // blocks that tell how many samples a picture has
constexpr double max_cut = 1e-3;       // of light, that white cuts off of blocks whose noise tells anything
constexpr double max_black_off = 0.1;  // of the pixels, by which a picture is black more or less often
constexpr double noise_factor = 2;     // by which noise tells the number of samples wrongly

/// The value below which a fraction of the values lies.
double quantile_of(std::vector<double> values, double fraction) {
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(fraction * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/// The variance between neighbours in a row, of each region and channel; negative where there are few.
std::vector<double> scatter_of(const std::vector<float>& light, const std::vector<float>& expected,
                               const Regions& regions, double white) {
  constexpr double min_pairs = 20;
  std::vector<double> sums(3 * static_cast<std::size_t>(regions.count)), counts(sums.size());
  for (std::size_t at = 3; at < light.size(); ++at) {
    const int region = regions.of_pixel[at / 3];
    if (region < 0 || regions.of_pixel[at / 3 - 1] != region) continue;
    if (static_cast<double>(std::max(expected[at], expected[at - 3])) > white) continue;
    const double step =
        static_cast<double>(light[at] - expected[at]) - static_cast<double>(light[at - 3] - expected[at - 3]);
    sums[3 * static_cast<std::size_t>(region) + at % 3] += step * step / 2;
    ++counts[3 * static_cast<std::size_t>(region) + at % 3];
  }
  for (std::size_t k = 0; k < sums.size(); ++k) sums[k] = counts[k] < min_pairs ? -1 : sums[k] / counts[k];
  return sums;
}

/// What a program's noise is over that of the picture.
double noise_ratio(const std::vector<double>& of_program, const std::vector<double>& of_picture) {
  double program = 0, picture = 0;
  for (std::size_t k = 0; k < of_program.size(); ++k)
    if (of_picture[k] >= 0) program += of_program[k], picture += of_picture[k];
  return picture > 0 ? program / picture : 0;
}

/// Median of that over blocks and channels, among those of much noise of which white cuts off little: right also where
/// edges lie elsewhere in the picture. 0: too few of them tell.
double median_noise_ratio(const std::vector<double>& of_program, const std::vector<double>& cut,
                          const std::vector<double>& of_picture) {
  const double median = quantile_of(of_program, 0.5);
  std::vector<double> ratios;
  for (std::size_t k = 0; k < of_program.size(); ++k)
    if (of_program[k] >= median && of_picture[k] > 0 && cut[k] <= max_cut)
      ratios.push_back(of_program[k] / of_picture[k]);
  // Edges that lie elsewhere in the picture make blocks look noisier than they are: so more than the median.
  return ratios.size() >= min_ratios ? quantile_of(ratios, 0.6) : 0;
}

/// The fraction of groups of samples that are black, over all pixels.
double black_fraction(const SampleStatistics& statistics) {
  double black = 0;
  for (const float part : statistics.black) black += static_cast<double>(part);
  return black / static_cast<double>(statistics.black.size());
}

struct PictureNoise {
  std::vector<double> variance;  ///< of a pixel, of each region and channel; negative: there are too few pixels
  double black = 0;              ///< fraction of the numbers that are black
};

/// From neighbours in a row, so that what changes slowly from pixel to pixel counts little; what is brighter than white
/// counts nothing.
PictureNoise noise_of(const ComparedPixels& picture, const Regions& regions, double white) {
  PictureNoise noise{scatter_of(picture.light, picture.expected, regions, white), 0};
  const std::vector<double> steps = means_of(picture.tolerance, regions),
                            of_reference = means_of(picture.variance, regions);
  for (std::size_t k = 0; k < noise.variance.size(); ++k) {
    double& variance = noise.variance[k];
    if (variance < 0) continue;
    const double rounding = steps[k] * steps[k] / 12;
    variance -= of_reference[k] + rounding;
    if (variance < rounding) variance = 0;
  }
  for (std::size_t at = 0; at < picture.light.size(); ++at)
    noise.black += picture.light[at] <= std::max(max_black, picture.tolerance[at]) ? 1 : 0;
  noise.black /= static_cast<double>(picture.light.size());
  return noise;
}

}  // namespace

std::vector<double> likely_counts(const ComparedPixels& picture, const std::vector<BookSample>& samples, int count,
                                  const Regions& regions, double white) {
  const PictureNoise noise = noise_of(picture, regions, white);
  std::vector<std::pair<double, double>> likely;  // how far off the noise is, and samples
  for (int group = 1; 2 * group <= count; ++group) {
    const SampleStatistics few = statistics_of(samples, count, {group, white});
    const double ratio = noise_ratio(means_of(few.noise, regions), noise.variance);
    if (ratio > 1 / noise_factor && ratio < noise_factor && std::abs(black_fraction(few) - noise.black) < max_black_off)
      likely.emplace_back(std::abs(std::log(ratio)), group);
  }
  const SampleStatistics many = statistics_of(samples, count, {count, white});
  const double told =
      median_noise_ratio(means_of(many.variance, regions), means_of(many.excess, regions), noise.variance);
  for (const double factor : {1.0, 1 / 1.1, 1.1, 1 / 1.25, 1.25, 1 / 1.4, 1.4, 1 / 1.7, 1.7, 0.5, 2.0})
    if (2 * factor * told > count) likely.emplace_back(std::abs(std::log(factor)), factor * told);
  std::stable_sort(likely.begin(), likely.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<double> counts;
  for (const auto& [off, of_picture] : likely) counts.push_back(of_picture);
  if (counts.empty()) counts = {0};
  return counts;
}

}  // namespace tyndall
