#include "app/check/statistics.h"

#include "core/image/tonemap.h"

namespace tyndall {
namespace {

constexpr double min_pairs = 20;       // of neighbours, that tell the noise of a cell
constexpr std::size_t min_ratios = 8;  // blocks that tell how many samples a picture has
constexpr double max_cut = 1e-3;       // of light, that white cuts off of blocks whose noise tells anything
constexpr double max_black_off = 0.1;  // of the pixels, by which a picture is black more or less often
constexpr double noise_factor = 2;     // by which noise tells the number of samples wrongly
constexpr double amount_errors = 3;    // standard errors that an amount leaves to noise
constexpr int min_pixels = 24;         // of a block that is compared

float light_of(TransferCurve curve, float number) {
  constexpr float powers[] = {1, 0, 2.2f, 2, 1, 4};  // in the order of TransferCurve; sRGB's curve is none
  const float power = powers[static_cast<std::size_t>(curve)];
  return curve == TransferCurve::srgb ? srgb_decode(number) : power == 1 ? number : std::pow(number, power);
}

/// Half of the light between the numbers one step above and below, at least that of a dark grey: in black no step can
/// be seen.
float tolerance_of(TransferCurve curve, float number, float step) {
  if (curve == TransferCurve::light) return step * std::max(std::abs(number), 0.02f);
  const float middle = std::clamp(number, 0.02f, 1 - step);
  return 0.5f * (light_of(curve, middle + step) - light_of(curve, middle - step));
}

/// One channel of a pixel.
SampleStatistics of_channel(const BookSample* samples, const BookSample* other, int count, const Exposure& exposure,
                            float Vec3f::*channel) {
  double of_group = 0, of_other = 0, excess = 0, black = 0;
  int in_group = 0;
  Pairs single, both, cut, cut_and_other;
  for (int k = 0; k < count; ++k) {
    const auto value = static_cast<double>(samples[k].light.*channel);
    const auto other_value = static_cast<double>(other[k].light.*channel);
    single.add(value, value), both.add(value, other_value), of_group += value, of_other += other_value;
    if (++in_group < exposure.group) continue;
    const double mean = of_group / exposure.group, shown = std::min(mean, exposure.white);
    cut.add(shown, shown), cut_and_other.add(shown, of_other / exposure.group), excess += mean - shown;
    black += mean < max_black ? 1 : 0;
    of_group = 0, of_other = 0, in_group = 0;
  }
  const double variance = std::max(0.0, single.covariance());
  const bool several = cut.count > 1;
  return {.mean = single.a / count,
          .variance = variance,
          .excess = excess / cut.count,
          .noise = several ? std::max(0.0, cut.covariance()) : variance / exposure.group,
          .common = several ? cut_and_other.covariance() : both.covariance() / exposure.group,
          .black = black / cut.count};
}

/// The value below which a fraction of the values lies.
double quantile_of(Numbers values, double fraction) {
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(fraction * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/// The variance of a pixel of the picture, of each cell; negative where there are too few pixels. From neighbours in a
/// row, so that what changes slowly from pixel to pixel counts little; what is brighter than white counts nothing.
Numbers noise_of(const LatticeLight& picture, const LatticeLight& reference, const Regions& regions, double white) {
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

std::vector<Reading> readings_of(bool coded, bool right) {
  std::vector<TransferCurve> curves{TransferCurve::light};
  if (coded)
    curves = {TransferCurve::gamma2, TransferCurve::srgb, TransferCurve::power22, TransferCurve::none,
              TransferCurve::gamma2_twice};
  std::vector<Reading> readings;
  for (const bool swapped : {false, true})
    for (const bool upside_down : {false, true})
      for (const bool mirrored : {false, true})
        for (const TransferCurve curve : curves)
          if (const Reading reading{curve, upside_down, mirrored, swapped}; reading.is_right() == right)
            readings.push_back(reading);
  return readings;
}

PictureNumbers numbers_of(const PictureFile& picture) {
  PictureNumbers result{picture.image.width, picture.image.height, picture.image.rgb};
  result.coded = picture.bits < 32;
  if (picture.kind == ImageKind::jpeg) result.step = 3 / 256.0f;
  if (!result.coded) {
    result.step = picture.kind == ImageKind::hdr ? 1 / 128.0f : 1 / 500.0f;
    return result;
  }
  // The books' programs round down, to one of 256 steps.
  const bool rounded_down = picture.kind == ImageKind::ppm && picture.bits == 8;
  for (float& value : result.numbers) {
    const float number = std::clamp(srgb_encode(value), 0.0f, 1.0f);
    value = rounded_down ? (std::round(255 * number) + 0.5f) / 256 : number;
  }
  return result;
}

LatticeLight read_pixels(const PictureNumbers& picture, const Lattice& lattice, const Reading& reading) {
  LatticeLight pixels;
  for (int y = 0; y < picture.height; y += lattice.step)
    for (int x = 0; x < picture.width; x += lattice.step) {
      const int column = reading.mirrored ? picture.width - 1 - x : x;
      const int row = reading.upside_down ? picture.height - 1 - y : y;
      const float* numbers = picture.numbers.data() + 3 * (std::ptrdiff_t{row} * picture.width + column);
      for (int c = 0; c < 3; ++c) {
        const float number = numbers[reading.swapped ? 2 - c : c];
        pixels.light.push_back(static_cast<double>(light_of(reading.curve, number)));
        pixels.tolerance.push_back(static_cast<double>(tolerance_of(reading.curve, number, picture.step)));
      }
    }
  return pixels;
}

std::vector<SampleStatistics> statistics_of(const std::vector<BookSample>& samples, int count, const Exposure& exposure,
                                            const std::vector<BookSample>* other) {
  std::vector<SampleStatistics> result;
  for (std::size_t first = 0; first < samples.size(); first += static_cast<std::size_t>(count))
    for (float Vec3f::*channel : each_channel)
      result.push_back(
          of_channel(samples.data() + first, (other ? *other : samples).data() + first, count, exposure, channel));
  return result;
}

Numbers excess_ratios(const std::vector<BookSample>& samples, int count, double many, const Regions& regions) {
  const auto n = static_cast<std::size_t>(count), pixels = samples.size() / n;
  const std::size_t together = std::min(pixels, static_cast<std::size_t>(std::ceil(many / count)));
  Numbers of_many(regions.cells()), of_few(regions.cells());
  for (std::size_t first = 0; first + together <= pixels; first += together)
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t cell = regions.cell_of(3 * first + c);
      if (cell == Regions::no_cell) continue;
      Numbers sums(together);  // of groups of about `count` samples, each with samples of all pixels
      for (std::size_t k = 0; k < together * n; ++k)
        sums[(k / n + k % n) % together] += static_cast<double>(samples[first * n + k].light.*each_channel[c]);
      double all = 0;
      for (const double sum : sums) of_few[cell] += std::max(0.0, sum / count - 1), all += sum;
      const auto groups = static_cast<double>(together);
      of_many[cell] += groups * std::max(0.0, all / (groups * count) - 1);
    }
  for (std::size_t k = 0; k < of_many.size(); ++k) of_many[k] = of_few[k] > 0 ? of_many[k] / of_few[k] : 1;
  return of_many;
}

Numbers light_by_depth(const std::vector<BookSample>& samples) {
  Numbers light;
  for (const BookSample& sample : samples) {
    const auto depth = static_cast<std::size_t>(sample.depth);
    if (light.size() <= depth) light.resize(depth + 1);
    light[depth] += static_cast<double>(sample.light.x + sample.light.y + sample.light.z);
  }
  for (std::size_t k = 1; k < light.size(); ++k) light[k] += light[k - 1];
  for (double& value : light) value /= std::max(light.back(), 1e-30);
  return light;
}

int edge_of_blocks(const Lattice& lattice) {
  const double edge = std::sqrt(static_cast<double>(lattice.pixels()) / 400);
  return std::clamp(static_cast<int>(std::lround(edge)), 8, 32);
}

Regions blocks_of(const Lattice& lattice, int edge) {
  const int across = (lattice.columns() + edge - 1) / edge, down = (lattice.rows() + edge - 1) / edge;
  Regions regions{{}, across * down};
  for (int y = 0; y < lattice.rows(); ++y)
    for (int x = 0; x < lattice.columns(); ++x) regions.of_pixel.push_back(y / edge * across + x / edge);
  return regions;
}

std::vector<CellDifference> differences_of(const LatticeLight& picture, const LatticeLight& expected,
                                           const Regions& regions) {
  std::vector<CellDifference> cells(regions.cells());  // sums at first
  Numbers squares(cells.size()), variances(cells.size());
  for (std::size_t at = 0; at < picture.light.size(); ++at) {
    const double difference = picture.light[at] - expected.light[at];
    const std::size_t k = regions.cell_of(at);
    if (k == Regions::no_cell || !std::isfinite(difference)) continue;
    CellDifference& sums = cells[k];
    ++sums.pixels, sums.expected += expected.light[at], sums.difference += difference;
    sums.tolerance += picture.tolerance[at];
    squares[k] += difference * difference, variances[k] += expected.variance[at];
  }
  for (std::size_t k = 0; k < cells.size(); ++k) {
    CellDifference& cell = cells[k];
    const double n = cell.pixels, mean = cell.difference / n;
    const double scatter = std::max(0.0, squares[k] - cell.difference * mean) / (n - 1);
    if (cell.pixels < min_pixels)
      cell = {};
    else
      cell = {cell.pixels, cell.expected / n, mean, std::sqrt(std::max(scatter, variances[k] / n) / n),
              cell.tolerance / n};
  }
  return cells;
}

Misfit misfit_of(std::span<const CellDifference> differences) {
  Misfit misfit;
  for (; !differences.empty(); differences = differences.subspan(3)) {
    const auto block = differences.first(3);
    if (block[0].pixels == 0) continue;
    ++misfit.blocks;
    misfit.different += std::ranges::any_of(block, [](auto& cell) { return cell.beyond(noise_limit, cell.error) > 0; });
  }
  return misfit;
}

double amount_of(std::span<const CellDifference> differences, std::span<const CellDifference> other) {
  double amount = 0;
  for (std::size_t k = 0; k < differences.size(); ++k)
    if (const CellDifference& cell = differences[k]; cell.pixels > 0)
      amount += cell.pixels * cell.beyond(amount_errors, std::max(cell.error, other[k].error)) / cell.tolerance;
  return amount;
}

std::multimap<double, double> likely_counts(const LatticeLight& picture, const LatticeLight& reference,
                                            const std::vector<BookSample>& samples, int count, const Regions& regions,
                                            double white) {
  const Numbers noise = noise_of(picture, reference, regions, white);
  double black = 0;
  for (std::size_t at = 0; at < picture.light.size(); ++at)
    black += picture.light[at] <= std::max(max_black, picture.tolerance[at]) ? 1 : 0;
  std::multimap<double, double> likely;
  for (int group = 1; 2 * group <= count; ++group) {
    const auto few = statistics_of(samples, count, {group, white});
    const double ratio = noise_ratio(means_of(regions, few, &SampleStatistics::noise), noise);
    double more_black = -black;
    for (const SampleStatistics& number : few) more_black += number.black;
    if (ratio > 1 / noise_factor && ratio < noise_factor &&
        std::abs(more_black) < max_black_off * static_cast<double>(few.size()))
      likely.emplace(std::abs(std::log(ratio)), group);
  }
  const auto many = statistics_of(samples, count, {count, white});
  const double told = median_noise_ratio(means_of(regions, many, &SampleStatistics::variance),
                                         means_of(regions, many, &SampleStatistics::excess), noise);
  for (const double factor : {1.0, 1 / 1.1, 1.1, 1 / 1.25, 1.25, 1 / 1.4, 1.4, 1 / 1.7, 1.7, 0.5, 2.0})
    if (2 * factor * told > count) likely.emplace(std::abs(std::log(factor)), factor * told);
  if (likely.empty()) likely = {{0, 0}};
  return likely;
}

}  // namespace tyndall
