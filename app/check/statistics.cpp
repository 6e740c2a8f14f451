#include "app/check/statistics.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

constexpr double amount_errors = 3;          // standard errors that an amount leaves to noise
constexpr int min_pixels = 24;               // of a block that is compared
constexpr double max_different = 1 / 150.0;  // of the small blocks of a picture that agrees
constexpr double min_seen = 0.25;            // of a difference must be seen beside the noise of another picture

struct Sums {
  double expected = 0, value = 0, square = 0, variance = 0, tolerance = 0;
};

double excess_of(const BlockDifference& b, double error, double errors) {
  return std::max(0.0, std::abs(b.difference) - b.tolerance - errors * error);
}

/// Pairs of numbers: their covariance.
struct Pairs {
  double a = 0, b = 0, products = 0, count = 0;
  void add(double x, double y) { a += x, b += y, products += x * y, ++count; }
  double covariance() const { return count > 1 ? (products - a * b / count) / (count - 1) : 0; }
};

/// One channel of a pixel.
void add_channel(const BookSample* samples, const BookSample* other, int count, const Exposure& exposure,
                 float Vec3f::*channel, SampleStatistics& to) {
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
    black += mean < static_cast<double>(max_black) ? 1 : 0;
    of_group = 0, of_other = 0, in_group = 0;
  }
  const double variance = std::max(0.0, single.covariance()), uncut = variance / exposure.group;
  const bool several = cut.count > 1;
  to.mean.push_back(static_cast<float>(single.a / count));
  to.variance.push_back(static_cast<float>(variance));
  to.excess.push_back(static_cast<float>(excess / cut.count));
  to.noise.push_back(static_cast<float>(several ? std::max(0.0, cut.covariance()) : uncut));
  to.black.push_back(static_cast<float>(black / cut.count));
  to.common.push_back(static_cast<float>(several ? cut_and_other.covariance() : both.covariance() / exposure.group));
}

}  // namespace

SampleStatistics statistics_of(const std::vector<BookSample>& samples, int count, const Exposure& exposure,
                               const std::vector<BookSample>* other) {
  SampleStatistics result;
  for (std::vector<float>* list :
       {&result.mean, &result.variance, &result.excess, &result.noise, &result.common, &result.black})
    list->reserve(3 * samples.size() / static_cast<std::size_t>(count));
  for (std::size_t first = 0; first < samples.size(); first += static_cast<std::size_t>(count))
    for (float Vec3f::*channel : {&Vec3f::x, &Vec3f::y, &Vec3f::z})
      add_channel(samples.data() + first, (other ? *other : samples).data() + first, count, exposure, channel, result);
  return result;
}

std::vector<double> excess_ratios(const std::vector<BookSample>& samples, int count, double many,
                                  const Regions& regions) {
  const auto n = static_cast<std::size_t>(count), pixels = samples.size() / n;
  const std::size_t together = std::min(pixels, static_cast<std::size_t>(std::ceil(many / count)));
  std::vector<double> of_many(3 * static_cast<std::size_t>(regions.count)), of_few(of_many.size());
  std::vector<double> sums(together);  // of groups of about `count` samples, each with samples of all pixels
  for (std::size_t first = 0; first + together <= pixels; first += together) {
    if (regions.of_pixel[first] < 0) continue;
    const std::size_t region = 3 * static_cast<std::size_t>(regions.of_pixel[first]);
    std::size_t c = 0;
    for (float Vec3f::*channel : {&Vec3f::x, &Vec3f::y, &Vec3f::z}) {
      std::fill(sums.begin(), sums.end(), 0);
      for (std::size_t k = 0; k < together * n; ++k)
        sums[(k / n + k % n) % together] += static_cast<double>(samples[first * n + k].light.*channel);
      double all = 0;
      for (const double sum : sums) {
        of_few[region + c] += std::max(0.0, sum / count - 1);
        all += sum;
      }
      of_many[region + c] += static_cast<double>(together) * std::max(0.0, all / static_cast<double>(together * n) - 1);
      ++c;
    }
  }
  for (std::size_t k = 0; k < of_many.size(); ++k) of_many[k] = of_few[k] > 0 ? of_many[k] / of_few[k] : 1;
  return of_many;
}

std::vector<double> light_by_depth(const std::vector<BookSample>& samples) {
  std::vector<double> light;
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

std::vector<double> means_of(const std::vector<float>& numbers, const Regions& regions) {
  std::vector<double> sums(3 * static_cast<std::size_t>(regions.count)), counts(sums.size());
  for (std::size_t at = 0; at < numbers.size(); ++at) {
    const int region = regions.of_pixel[at / 3];
    if (region < 0) continue;
    sums[3 * static_cast<std::size_t>(region) + at % 3] += static_cast<double>(numbers[at]);
    ++counts[3 * static_cast<std::size_t>(region) + at % 3];
  }
  for (std::size_t k = 0; k < sums.size(); ++k) sums[k] /= std::max(counts[k], 1.0);
  return sums;
}

std::vector<BlockDifference> block_differences(const ComparedPixels& p, const Regions& regions) {
  std::vector<Sums> sums(3 * static_cast<std::size_t>(regions.count));
  std::vector<BlockDifference> result(sums.size());
  for (std::size_t pixel = 0; pixel < regions.of_pixel.size(); ++pixel) {
    if (regions.of_pixel[pixel] < 0) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t at = 3 * pixel + c, block = 3 * static_cast<std::size_t>(regions.of_pixel[pixel]) + c;
      const double difference = static_cast<double>(p.light[at]) - static_cast<double>(p.expected[at]);
      if (!std::isfinite(difference)) continue;
      Sums& sum = sums[block];
      sum.expected += static_cast<double>(p.expected[at]);
      sum.value += difference, sum.square += difference * difference;
      sum.variance += static_cast<double>(p.variance[at]), sum.tolerance += static_cast<double>(p.tolerance[at]);
      ++result[block].pixels;
    }
  }
  for (std::size_t k = 0; k < result.size(); ++k) {
    BlockDifference& block = result[k];
    const Sums& sum = sums[k];
    if (block.pixels < min_pixels) {
      block = {};
      continue;
    }
    const double n = block.pixels, mean = sum.value / n;
    const double scatter = std::max(0.0, sum.square - sum.value * mean) / (n - 1);
    block = {block.pixels, sum.expected / n, mean, std::sqrt(std::max(scatter, sum.variance / n) / n),
             sum.tolerance / n};
  }
  return result;
}

Misfit misfit_of(std::span<const BlockDifference> differences) {
  Misfit misfit;
  for (std::size_t block = 0; block < differences.size(); block += 3) {
    if (differences[block].pixels == 0) continue;
    bool different = false;
    for (std::size_t c = 0; c < 3; ++c)
      different = different || excess_of(differences[block + c], differences[block + c].error, noise_limit) > 0;
    ++misfit.blocks;
    misfit.different += different ? 1 : 0;
  }
  misfit.amount = amount_of(differences, differences);
  return misfit;
}

double amount_of(std::span<const BlockDifference> differences, std::span<const BlockDifference> other) {
  double amount = 0;
  for (std::size_t k = 0; k < differences.size(); ++k) {
    const BlockDifference& block = differences[k];
    if (block.pixels == 0) continue;
    amount += block.pixels * excess_of(block, std::max(block.error, other[k].error), amount_errors) / block.tolerance;
  }
  return amount;
}

bool agrees_in_blocks(const RegionDifferences& regions) {
  const Misfit small = misfit_of(regions.of_small());
  return small.different <= max_different * small.blocks;
}

bool agrees(const RegionDifferences& regions) {
  return agrees_in_blocks(regions) && misfit_of(regions.of_large()).different == 0 &&
         misfit_of(regions.of_objects()).different == 0 && misfit_of(regions.whole).different == 0;
}

double left_by(const RegionDifferences& old, const RegionDifferences& now) {
  double before = 0, after = 0;
  for (std::size_t k = 0; k < old.all.size(); ++k) {
    const BlockDifference &a = old.all[k], &b = now.all[k];
    const double error = std::max(a.error, b.error);
    if (a.pixels == 0 || std::abs(a.difference - b.difference) <= a.tolerance + 2 * error) continue;
    const double weight = a.pixels / a.tolerance;
    before += weight * std::max(0.0, std::abs(a.difference) - 2 * error);
    after += weight * std::max(0.0, std::abs(b.difference) - 2 * error);
  }
  return before > 0 ? after / before : 1;
}

double gone(const RegionDifferences& before, const RegionDifferences& after) {
  const double seen = amount_of(before.all, after.all);
  return seen > min_seen * before.amount() ? 1 - amount_of(after.all, before.all) / seen : 0;
}

bool clearly_closer(const RegionDifferences& a, const RegionDifferences& b) {
  return amount_of(a.all, b.all) < clear_improvement * amount_of(b.all, a.all);
}

double unseen_light(const RegionDifferences& regions) {
  double light = 0, unseen = 0;
  for (const BlockDifference& channel : regions.whole)
    light += channel.expected, unseen += channel.tolerance + noise_limit * channel.error;
  return light > 0 ? unseen / light : 0;
}

std::vector<ObjectDifference> different_objects(const RegionDifferences& regions) {
  std::vector<ObjectDifference> found;
  const auto objects = regions.of_objects();
  for (std::size_t k = 0; k < objects.size(); k += 3) {
    const auto channels = objects.subspan(k, 3);
    if (misfit_of(channels).different == 0) continue;
    const Vec3d expected{channels[0].expected, channels[1].expected, channels[2].expected};
    const Vec3d off{channels[0].difference, channels[1].difference, channels[2].difference};
    found.push_back({static_cast<int>(k / 3), channels[0].pixels, expected + off, expected});
  }
  const auto amount = [](const ObjectDifference& d) {
    const Vec3d off = d.image - d.expected;
    return d.pixels * (std::abs(off.x) + std::abs(off.y) + std::abs(off.z));
  };
  std::sort(found.begin(), found.end(),
            [&](const ObjectDifference& a, const ObjectDifference& b) { return amount(a) > amount(b); });
  return found;
}

}  // namespace tyndall
