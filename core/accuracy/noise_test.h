#pragma once
#include "core/film/film.h"

#include <array>
#include <optional>
#include <vector>

/// Tests whether two pictures differ by more than the noise that they carry, without tolerances.
///
/// **The error of a block.** The noise of pixels that reuse each other's second vertices is correlated (film/groups.h),
/// so sums over whole groups are compared: a block of 16 x 16 pixels has 32 of them. Each picture gives a group's sum
/// twice, from two independent halves of its samples. Of the four sums a1, a2, b1, b2 let
///
///     D = (a1 + a2 - b1 - b2) / 2,   E = (a1 - a2 + b1 - b2) / 2,   F = (a1 - a2 - b1 + b2) / 2.
///
/// If the pictures differ by noise alone, all three have the same variance. D is what is tested, E and F say how large
/// it may be: with 64 degrees of freedom a block, where the halves of the block as a whole would give 2.
///
/// **Few and bright samples.** Where both pictures have as many samples a pixel, noise makes every exchange of the four
/// sums of a group equally likely. Given |D|, |E| and |F| of each group, D is then one of ±D, ±E, ±F, and the moments
/// of such a number are at most those of a normal one of the variance V = (D² + E² + F²) / 3. So, whatever the
/// distribution of the samples (W. Hoeffding, J. Amer. Statist. Assoc. 58, 1963),
///
///     P(|sum of D| > t sqrt(sum of V)) <= 2 exp(-t² / 2).
///
/// This is the test where there are few effective samples. Elsewhere means and blocks are tested by Student's t with
/// the variance of E and F alone, which is more powerful, as a change of the picture is not in it. A third of the three
/// largest D² is added, so that chance meetings of two rare samples in a group cannot decide. A change of a single
/// pixel can therefore not be told from such a meeting.
namespace tyndall {

/// A picture whose noise is known: pixels of the region, row by row, 3 numbers each.
struct NoisyImage {
  Region region;
  std::vector<float> mean;
  /// With `halves`: half of the difference of the means of the halves, with its sign. Otherwise the standard error.
  std::vector<float> deviation;
  bool halves = false;
  bool correlated = false;  ///< without halves: the pixels of a group may be correlated; taken to be so entirely
  double spp = 0;           ///< samples a pixel; 0: not known
};

/// The pixels that both have.
Region common_part(const Region& a, const Region& b);

/// The film with its halves; nothing while a half of some pixel is empty.
std::optional<NoisyImage> noisy_image(const Film& film);

/// Effective samples up to which a block is too noisy to be told about: (sum of the light of both pictures)² /
/// variance, which is the number of samples if all have the same light, or none. With 60 the difference of the two
/// pictures has a standard error of a quarter of their light.
inline constexpr double too_few_effective_samples = 60;

/// The scores z are those of one normal number: corrected for the number of tests, so that noise gives a pair of
/// pictures a z above 4 once in 16,000 times.
struct NoiseScores {
  double z = 0;  ///< the largest of all

  std::array<double, 3> mean_z{};               ///< of the mean of each channel
  std::array<double, 3> difference{}, error{};  ///< of the means: image minus reference, and its standard error

  int blocks = 0;                ///< of 16 x 16 pixels; those at the edges may be smaller
  int lit_blocks = 0;            ///< of them, with a mean above its own noise in some channel of either picture
  int unclear_blocks = 0;        ///< of those, with too few effective samples: only a large difference would show
  double effective_samples = 0;  ///< the most that a lit channel of a block has
  double enough_spp = 0;  ///< samples a pixel that would do where no block can tell; 0: one can, or it is not known
  double block_z = 0;     ///< the largest of all blocks and channels
  Region worst_block;     ///< its pixels
  std::vector<float> z_of_block;  ///< the largest of the channels, row by row

  /// Pixels whose difference is above 5 standard errors of the 3 x 3 pixels around, and the number that noise explains:
  /// E and F have as many by chance. Only for films of as many samples.
  bool compares_outliers = false;
  int outliers = 0;
  double explained_outliers = 0;
  double outlier_z = 0;

  /// Whether there is a block that would have shown a difference, or none that could differ: what is black in both
  /// pictures is no evidence.
  bool tells() const { return unclear_blocks < lit_blocks || lit_blocks == 0; }
  int blocks_above(double z) const;
};

/// Compares the pixels that both have, by position; they must have some.
NoiseScores noise_scores(const NoisyImage& image, const NoisyImage& reference);

}  // namespace tyndall
