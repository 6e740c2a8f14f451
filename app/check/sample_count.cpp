#include "app/check/statistics.h"

#include <utility>

namespace tyndall {
namespace {

constexpr double min_pairs = 20;       // of neighbours, that tell the noise of a cell
constexpr std::size_t min_ratios = 8;  // blocks that tell how many samples a picture has
constexpr double max_cut = 1e-3;       // of light, that white cuts off of blocks whose noise tells anything
constexpr double max_black_off = 0.1;  // of the pixels, by which a picture is black more or less often
constexpr double noise_factor = 2;     // by which noise tells the number of samples wrongly

/// The value below which a fraction of the values lies.
double quantile_of(Numbers values, double fraction) {
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(fraction * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/// The variance of a pixel of the picture, of each cell; negative where there are too few pixels. From neighbours in a
/// row, so that what changes slowly from pixel to pixel counts little; what is brighter than white counts nothing.
Numbers noise_of(const ReadPixels& picture, const ExpectedPixels& reference, const Regions& regions, double white) {
  Numbers noise(regions.cells()), counts(regions.cells());
  for (std::size_t at = 3; at < picture.light.size(); ++at) {
    const std::size_t cell = regions.cell_of(at);
    if (cell == Regions::no_cell || regions.cell_of(at - 3) != cell) continue;
    if (std::max(reference.light[at], reference.light[at - 3]) > white) continue;
    const double step = picture.light[at] - reference.light[at] - (picture.light[at - 3] - reference.light[at - 3]);
    noise[cell] += step * step / 2, ++counts[cell];
  }
  const Numbers steps = means_of(regions, picture.tolerance), of_reference = means_of(regions, reference.variance);
  for (std::size_t k = 0; k < noise.size(); ++k) {
    const double rounding = steps[k] * steps[k] / 12, known = of_reference[k] + rounding;
    const double variance = noise[k] / counts[k] - known;
    noise[k] = counts[k] < min_pairs ? -1 : variance < rounding ? 0 : variance;
  }
  return noise;
}

/// What a program's noise is over that of the picture.
double noise_ratio(const Numbers& of_program, const Numbers& of_picture) {
  double program = 0, picture = 0;
  for (std::size_t k = 0; k < of_program.size(); ++k)
    if (of_picture[k] >= 0) program += of_program[k], picture += of_picture[k];
  return picture > 0 ? program / picture : 0;
}

/// Median of that over the cells, among those of much noise of which white cuts off little: right also where edges lie
/// elsewhere in the picture. 0: too few of them tell.
double median_noise_ratio(const Numbers& of_program, const Numbers& cut, const Numbers& of_picture) {
  const double median = quantile_of(of_program, 0.5);
  Numbers ratios;
  for (std::size_t k = 0; k < of_program.size(); ++k)
    if (of_program[k] >= median && of_picture[k] > 0 && cut[k] <= max_cut)
      ratios.push_back(of_program[k] / of_picture[k]);
  // Edges that lie elsewhere in the picture make blocks look noisier than they are: so more than the median.
  return ratios.size() >= min_ratios ? quantile_of(ratios, 0.6) : 0;
}

}  // namespace

std::vector<double> likely_counts(const ReadPixels& picture, const ExpectedPixels& reference,
                                  const std::vector<BookSample>& samples, int count, const Regions& regions,
                                  double white) {
  const Numbers noise = noise_of(picture, reference, regions, white);
  double black = 0;
  for (std::size_t at = 0; at < picture.light.size(); ++at)
    black += picture.light[at] <= std::max(max_black, picture.tolerance[at]) ? 1 : 0;
  std::vector<std::pair<double, double>> likely;  // how far off the noise is, and samples
  for (int group = 1; 2 * group <= count; ++group) {
    const auto few = statistics_of(samples, count, {group, white});
    const double ratio = noise_ratio(means_of(regions, few, &SampleStatistics::noise), noise);
    double more_black = -black;
    for (const SampleStatistics& number : few) more_black += number.black;
    if (ratio > 1 / noise_factor && ratio < noise_factor &&
        std::abs(more_black) < max_black_off * static_cast<double>(few.size()))
      likely.emplace_back(std::abs(std::log(ratio)), group);
  }
  const auto many = statistics_of(samples, count, {count, white});
  const double told = median_noise_ratio(means_of(regions, many, &SampleStatistics::variance),
                                         means_of(regions, many, &SampleStatistics::excess), noise);
  for (const double factor : {1.0, 1 / 1.1, 1.1, 1 / 1.25, 1.25, 1 / 1.4, 1.4, 1 / 1.7, 1.7, 0.5, 2.0})
    if (2 * factor * told > count) likely.emplace_back(std::abs(std::log(factor)), factor * told);
  std::stable_sort(likely.begin(), likely.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<double> counts;
  for (const auto& [off, of_picture] : likely) counts.push_back(of_picture);
  if (counts.empty()) counts = {0};
  return counts;
}

}  // namespace tyndall
