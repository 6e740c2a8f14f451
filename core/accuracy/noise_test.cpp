#include "core/accuracy/noise_test.h"

#include "core/film/groups.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace tyndall {
namespace {

constexpr int edge = 16;              // of a block: whole groups
constexpr double rounding = 0x1p-18;  // relative difference that other instructions may make
constexpr double equal_counts = 1.1;  // ratio of samples a pixel up to which halves of both can be exchanged
constexpr float outlier_ratio = 25;   // squared standard errors

double squared(double x) { return x * x; }

/// The rest of a division that is rounded down: positions may be negative.
int within(int position, int size) { return (position % size + size) % size; }

/// ln P(|x| > z) of a normal number, z >= 0.
double log_probability(double z) {
  if (z < 20) return std::log(std::erfc(z / std::numbers::sqrt2));
  const double series = 1 - 1 / squared(z) + 3 / squared(squared(z));  // Abramowitz & Stegun 7.1.23
  return -squared(z) / 2 - std::log(z * std::sqrt(std::numbers::pi / 2)) + std::log(series);
}

/// The z >= 0 of that logarithm of a probability; 0 for those from 1 on.
double z_of(double log_p) {
  if (log_p >= 0) return 0;
  double low = 0, high = std::sqrt(-2 * log_p) + 1;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (log_probability(middle) > log_p ? low : high) = middle;
  }
  return low;
}

/// Hoeffding's bound for |x| > z.
double log_bound(double z) { return std::min(0.0, std::numbers::ln2 - squared(z) / 2); }

/// The normal score as unlikely as Student's t (D. L. Wallace, Ann. Math. Statist. 30, 1959).
double normal_score(double t, double freedom) {
  if (!(freedom < 1e6)) return t;
  return (8 * freedom + 1) / (8 * freedom + 3) * std::sqrt(freedom * std::log1p(squared(t) / freedom));
}

/// What one channel of a group of pixels has in a picture.
struct GroupValue {
  double level = 0;                   ///< sum of the means
  double deviation = 0, squares = 0;  ///< sums of the deviations and of their squares
  double variance(const NoisyImage& image) const {
    return image.halves || image.correlated ? squared(deviation) : squares;
  }
};

/// Sums over the groups of a block or of a picture, of one channel. a: the image, b: the reference.
struct GroupSums {
  double level_a = 0, level_b = 0, variance_a = 0, variance_b = 0;
  double difference = 0, squares = 0;  ///< of D and D²
  double fourths = 0;                  ///< of the squared variances
  std::array<double, 3> largest{};     ///< the largest D², in ascending order
  double groups = 0;

  void add(double a, double b, double of_a, double of_b) {
    const double difference_ = a - b, allowed = rounding * (std::abs(a) + std::abs(b)) / 2;
    const double d = std::copysign(std::max(0.0, std::abs(difference_) - allowed), difference_);
    level_a += a, level_b += b, variance_a += of_a, variance_b += of_b;
    difference += d, squares += d * d, fourths += squared(of_a) + squared(of_b), ++groups;
    if (d * d <= largest[0]) return;
    largest[0] = d * d;
    std::sort(largest.begin(), largest.end());
  }
  double variance() const { return variance_a + variance_b; }
  /// V of the header.
  double robust_variance() const { return (squares + 2 * variance()) / 3; }
};

/// The result of one test.
struct Score {
  double log_p = 0;
  bool lit = false;  ///< the mean of either picture is above its own noise
  double effective_samples = 0;
  bool clear() const { return effective_samples > too_few_effective_samples; }
};

/// How the samples of two pictures are to each other.
struct Counts {
  double ratio = 1;  ///< samples of the image over those of the reference
  bool exchangeable = true;
  Counts(const NoisyImage& a, const NoisyImage& b) {
    const bool known = a.spp > 0 && b.spp > 0;
    ratio = known ? a.spp / b.spp : 1;
    exchangeable = known && ratio < equal_counts && ratio > 1 / equal_counts;
  }
};

/// The score of a block, or of the picture.
Score score_of(GroupSums sums, const Counts& counts) {
  Score score;
  const auto above_noise = [](double level, double variance) {
    return level > 0 && squared(level) >= variance * (1 - rounding);  // a single sample is as bright as its noise
  };
  score.lit = above_noise(sums.level_a, sums.variance_a) || above_noise(sums.level_b, sums.variance_b);
  score.effective_samples = std::numeric_limits<double>::infinity();
  if (!counts.exchangeable) {
    // Where one picture has fewer samples, its own noise may show too little of rare bright ones: it has at least the
    // variance that the other picture, which has met more of them, has for as many samples.
    const double a = sums.variance_a, b = sums.variance_b;
    sums.variance_a = std::max(a, b / counts.ratio), sums.variance_b = std::max(b, a * counts.ratio);
  }
  if (!(sums.robust_variance() > 0)) return score;
  if (counts.exchangeable)
    score.effective_samples = squared(sums.level_a + sums.level_b) / sums.robust_variance();
  else
    score.effective_samples =
        std::min(squared(sums.level_a) / sums.variance_a, squared(sums.level_b) / sums.variance_b);
  if (!score.clear()) {
    if (counts.exchangeable) score.log_p = log_bound(sums.difference / std::sqrt(sums.robust_variance()));
    return score;
  }
  const double meetings = (sums.largest[0] + sums.largest[1] + sums.largest[2]) / 3;
  const double t = std::abs(sums.difference) / std::sqrt(sums.variance() + meetings);
  // F. E. Satterthwaite, Biometrics Bulletin 2, 1946, with the fourth moments that single numbers have.
  const double max_freedom = 2 * sums.groups;
  const double freedom =
      sums.fourths > 0 ? 3 * squared(sums.variance_a + sums.variance_b) / sums.fourths - 2 : max_freedom;
  score.log_p = log_probability(normal_score(t, std::clamp(freedom, 1.0, max_freedom)));
  return score;
}

/// The groups of a block: spacing² in each half of 8 rows.
using BlockGroups =
    std::array<std::array<GroupValue, 3>, std::size_t{group_spacing} * group_spacing*(edge / block_height)>;

std::size_t index_of(const Region& region, int x, int y) {
  return 3 * (static_cast<std::size_t>(y - region.y0) * static_cast<std::size_t>(region.width()) +
              static_cast<std::size_t>(x - region.x0));
}

std::size_t group_of(int x, int y) {
  const int half = within(y, edge) / block_height, row = within(y, group_spacing), column = within(x, group_spacing);
  const int groups_above = half * group_spacing + row;
  return static_cast<std::size_t>(groups_above) * group_spacing + static_cast<std::size_t>(column);
}

BlockGroups groups_of(const NoisyImage& image, const Region& block) {
  BlockGroups groups{};
  for (int y = block.y0; y < block.y1; ++y)
    for (int x = block.x0; x < block.x1; ++x) {
      const std::size_t at = index_of(image.region, x, y);
      for (std::size_t c = 0; c < 3; ++c) {
        GroupValue& group = groups[group_of(x, y)][c];
        const auto deviation = static_cast<double>(image.deviation[at + c]);
        group.level += static_cast<double>(image.mean[at + c]);
        group.deviation += deviation, group.squares += squared(deviation);
      }
    }
  return groups;
}

/// The sums of each channel of a block, which are added to those of the picture.
std::array<GroupSums, 3> sums_of(const NoisyImage& a, const NoisyImage& b, const Region& block,
                                 std::array<GroupSums, 3>& picture) {
  const BlockGroups of_a = groups_of(a, block), of_b = groups_of(b, block);
  std::array<GroupSums, 3> sums{};
  for (std::size_t g = 0; g < of_a.size(); ++g)
    for (std::size_t c = 0; c < 3; ++c) {
      const GroupValue &in_a = of_a[g][c], &in_b = of_b[g][c];
      for (GroupSums* to : {&sums[c], &picture[c]}) to->add(in_a.level, in_b.level, in_a.variance(a), in_b.variance(b));
    }
  return sums;
}

/// D², E² and F² of each pixel, summed over the channels.
using Energies = std::vector<std::array<float, 3>>;

Energies energies_of(const NoisyImage& a, const NoisyImage& b, const Region& region) {
  Energies energies;
  for (int y = region.y0; y < region.y1; ++y)
    for (int x = region.x0; x < region.x1; ++x) {
      const std::size_t in_a = index_of(a.region, x, y), in_b = index_of(b.region, x, y);
      std::array<float, 3>& sums = energies.emplace_back();
      for (std::size_t c = 0; c < 3; ++c) {
        const float mean_a = a.mean[in_a + c], mean_b = b.mean[in_b + c];
        const float d = mean_a - mean_b, allowed = static_cast<float>(rounding) * (std::abs(mean_a) + std::abs(mean_b));
        const float e = a.deviation[in_a + c] + b.deviation[in_b + c],
                    f = a.deviation[in_a + c] - b.deviation[in_b + c];
        sums[0] += std::abs(d) > allowed ? d * d : 0.0f;
        sums[1] += e * e, sums[2] += f * f;
      }
    }
  return energies;
}

/// Which of D, E and F stand out of the other two around the pixel: bits 0 to 2.
int outliers_at(const Energies& energies, int width, int height, int x, int y) {
  float around[3] = {}, count = 0;
  const auto at = [width](int i, int j) {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(width) + static_cast<std::size_t>(i);
  };
  for (int j = std::max(y - 1, 0); j <= std::min(y + 1, height - 1); ++j)
    for (int i = std::max(x - 1, 0); i <= std::min(x + 1, width - 1); ++i) {
      ++count;
      for (std::size_t k = 0; k < 3; ++k) around[k] += energies[at(i, j)][k];
    }
  int found = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const float noise = (around[(k + 1) % 3] + around[(k + 2) % 3]) / (2 * count);
    found |= energies[at(x, y)][k] > outlier_ratio * noise ? 1 << k : 0;
  }
  return found;
}

/// Counts the outliers of D, and those of E and F. The three numbers of a block of groups are equally likely to be
/// exchanged; by how far they lie apart Hoeffding's inequality for bounded numbers says how much chance can make of it.
double count_outliers(const NoisyImage& a, const NoisyImage& b, const Region& region, NoiseScores& scores) {
  const Energies energies = energies_of(a, b, region);
  const int width = region.width(), height = region.height();
  const auto columns = static_cast<std::size_t>(width / block_width) + 2;
  std::vector<std::array<int, 3>> blocks(columns * static_cast<std::size_t>(height / block_height + 2));
  const int first_column = region.x0 / block_width, first_row = region.y0 / block_height;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int found = outliers_at(energies, width, height, x, y);
      if (found == 0) continue;
      const int column = (region.x0 + x) / block_width - first_column, row = (region.y0 + y) / block_height - first_row;
      const std::size_t block = static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column);
      for (std::size_t k = 0; k < 3; ++k) blocks[block][k] += found >> k & 1;
    }
  double excess = 0, ranges = 0, explained = 0;
  for (const auto& [d, e, f] : blocks) {
    scores.outliers += d, explained += (e + f) / 2.0, excess += d - (e + f) / 2.0;
    ranges += squared(1.5 * (std::max({d, e, f}) - std::min({d, e, f})));
  }
  scores.explained_outliers = explained;
  return excess <= 0 ? 0 : log_bound(2 * excess / std::sqrt(ranges));
}

/// The score after correction for `tests` tests of a kind, and for the kinds.
double corrected(double log_p, double tests, int kinds) { return z_of(log_p + std::log(tests * kinds)); }

}  // namespace

Region common_part(const Region& a, const Region& b) {
  return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

std::optional<NoisyImage> noisy_image(const Film& film) {
  NoisyImage image{film.region, {}, {}, true};
  double samples = 0;
  for (const FilmPixel& pixel : film.pixels) {
    if (counted(film, pixel, 0) == 0 || counted(film, pixel, 1) == 0) return {};
    samples += pixel.taken;
    const Vec3f whole = mean(film, pixel), half = 0.5f * (half_mean(film, pixel, 0) - half_mean(film, pixel, 1));
    image.mean.insert(image.mean.end(), {whole.x, whole.y, whole.z});
    image.deviation.insert(image.deviation.end(), {half.x, half.y, half.z});
  }
  image.spp = samples / static_cast<double>(film.pixels.size());
  return image;
}

int NoiseScores::blocks_above(double limit) const {
  return static_cast<int>(
      std::count_if(z_of_block.begin(), z_of_block.end(), [limit](float v) { return static_cast<double>(v) > limit; }));
}

NoiseScores noise_scores(const NoisyImage& a, const NoisyImage& b) {
  NoiseScores scores;
  const Region r = common_part(a.region, b.region);
  const Counts counts(a, b);
  std::array<GroupSums, 3> picture{};
  struct Tested {
    Region block;
    double log_p = 0;
  };
  std::vector<Tested> blocks;
  for (int y0 = r.y0 - within(r.y0, edge); y0 < r.y1; y0 += edge)
    for (int x0 = r.x0 - within(r.x0, edge); x0 < r.x1; x0 += edge) {
      Tested& tested = blocks.emplace_back();
      tested.block = common_part({x0, y0, x0 + edge, y0 + edge}, r);
      bool lit = false, tells = false;
      for (const GroupSums& sums : sums_of(a, b, tested.block, picture)) {
        const Score score = score_of(sums, counts);
        lit = lit || score.lit, tells = tells || (score.lit && score.clear());
        if (score.lit) scores.effective_samples = std::max(scores.effective_samples, score.effective_samples);
        tested.log_p = std::min(tested.log_p, score.log_p);
      }
      scores.lit_blocks += lit ? 1 : 0, scores.unclear_blocks += lit && !tells ? 1 : 0;
    }
  scores.blocks = static_cast<int>(blocks.size());
  scores.compares_outliers = a.halves && b.halves && counts.exchangeable;
  const int kinds = scores.compares_outliers ? 3 : 2;
  const double pixels = static_cast<double>(r.width()) * r.height();
  for (std::size_t c = 0; c < 3; ++c) {
    scores.mean_z[c] = corrected(score_of(picture[c], counts).log_p, 3, kinds);
    scores.difference[c] = (picture[c].level_a - picture[c].level_b) / pixels;
    scores.error[c] = std::sqrt(picture[c].variance()) / pixels;
    scores.z = std::max(scores.z, scores.mean_z[c]);
  }
  for (const Tested& tested : blocks) {
    const double z = corrected(tested.log_p, 3.0 * scores.blocks, kinds);
    scores.z_of_block.push_back(static_cast<float>(z));
    if (z > scores.block_z || blocks.data() == &tested) scores.worst_block = tested.block;
    scores.block_z = std::max(scores.block_z, z);
  }
  if (scores.compares_outliers) scores.outlier_z = corrected(count_outliers(a, b, r, scores), 1, kinds);
  scores.z = std::max({scores.z, scores.block_z, scores.outlier_z});
  if (!scores.tells())
    scores.enough_spp =
        1.1 * std::min(a.spp, b.spp) * too_few_effective_samples / std::max(scores.effective_samples, 1.0);
  return scores;
}

}  // namespace tyndall
