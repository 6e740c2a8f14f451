#pragma once
#include "app/check/book_paths.h"
#include "core/scene/scene.h"

#include <span>
#include <string>
#include <vector>

/// What many samples of each pixel tell: the picture that a program would have shown of them, and how noisy it is; and
/// how two pictures differ, by blocks, by objects and as a whole, and whether that is more than noise.
namespace tyndall {

/// Of each pixel and channel, 3 floats a pixel.
struct SampleStatistics {
  std::vector<float> mean;
  std::vector<float> variance;  ///< of one sample
  /// By how much white cuts the mean of a picture: the part of a mean of `group` samples that is above it, averaged.
  std::vector<float> excess;
  std::vector<float> noise;   ///< variance of a mean of `group` samples, cut at white
  std::vector<float> common;  ///< covariance of such a mean with that of other samples, which is not cut
  std::vector<float> black;   ///< fraction of such means that are below max_black
};
inline constexpr float max_black = 1e-3f;

/// What a picture holds of a pixel's samples: the mean of `group` of them, at most `white`.
struct Exposure {
  int group = 1;
  double white = 1;  ///< infinity for pictures that are not cut
};

/// count: samples a pixel, from Exposure::group on. Where there are not two groups, noise and common are those of means
/// that are not cut. other: of the same random numbers; null: the samples themselves.
SampleStatistics statistics_of(const std::vector<BookSample>& samples, int count, const Exposure& exposure,
                               const std::vector<BookSample>* other = nullptr);

/// What white cuts off of means of many samples, over what it cuts off of means of `count`, of each region and channel.
/// many: more samples than there are of a pixel, so that those of neighbours are taken together; in the same way for
/// both. 1 where nothing is cut off.
std::vector<double> excess_ratios(const std::vector<BookSample>& samples, int count, double many,
                                  const struct Regions& regions);

/// Fraction of the light of samples that is found after at most so many scattering events, from 0 on.
std::vector<double> light_by_depth(const std::vector<BookSample>& samples);

/// Sets of pixels whose mean differences are looked at.
struct Regions {
  std::vector<int> of_pixel;  ///< -1: the pixel is in none
  int count = 0;
};

/// The object that is seen first through the centre of each pixel of a lattice.
struct SeenObjects {
  struct Object {
    std::string name;            ///< "the sky", `"ball" (glass)`
    std::string kind;            ///< "sky", "glass", "metal", "matt surfaces", "lights", "smoke", "moving objects"
    bool noisy_texture = false;  ///< it has a noise texture, whose veins lie elsewhere in Tyndall
  };
  std::vector<Object> objects;
  std::vector<int> of_pixel;  ///< index into objects
};
SeenObjects seen_objects(const Scene& scene, const Lattice& lattice);

/// The objects as regions: the pixels around which the same object is seen. Objects of a noise texture have none.
Regions regions_of(const SeenObjects& seen, const Lattice& lattice);
/// Squares of a lattice, `edge` of its pixels wide; those at the right and the lower edge may be smaller.
Regions blocks_of(const Lattice& lattice, int edge);
/// The edge of some 400 blocks, with as many pixels each as statistics need.
int edge_of_blocks(const Lattice& lattice);
/// Means over the pixels of each region and channel, of three numbers a pixel.
std::vector<double> means_of(const std::vector<float>& numbers, const Regions& regions);

/// The mean difference in one channel of a region.
struct BlockDifference {
  int pixels = 0;
  double expected = 0;    ///< mean over the pixels
  double difference = 0;  ///< mean of the picture minus that
  double error = 0;       ///< standard error of the mean
  double tolerance = 0;   ///< by how much it may be off without noise
};

/// What is compared.
struct ComparedPixels {
  const std::vector<float>& light;      ///< of the picture, 3 floats a pixel
  const std::vector<float>& expected;   ///< likewise
  const std::vector<float>& tolerance;  ///< likewise
  const std::vector<float>& variance;   ///< of each pixel's noise, as far as it is known; likewise
};

/// Three of each region. The error of a region is the greater of two: what the scatter of its pixels' differences
/// shows, and what their known variance predicts. The first also holds the noise of the expected values. The second is
/// right where rare bright paths have not happened to be met.
std::vector<BlockDifference> block_differences(const ComparedPixels& pixels, const Regions& regions);

/// Standard errors beyond which a difference is no noise. Errors are estimated, and the noise of few samples is no
/// normal distribution, so that now and then a block of a right picture is beyond, too.
inline constexpr double noise_limit = 5;

/// How much two pictures differ by more than noise.
struct Misfit {
  int blocks = 0;     ///< that were compared
  int different = 0;  ///< in some channel by more than their tolerance and noise_limit errors
  double amount = 0;  ///< of the difference beyond tolerance and 3 errors, in tolerances, summed over all pixels
};
Misfit misfit_of(std::span<const BlockDifference> differences);
/// The amount alone, where each block's error is the greater of its own and that of `other`: two amounts that are
/// compared must not differ because one of the pictures is noisier.
double amount_of(std::span<const BlockDifference> differences, std::span<const BlockDifference> other);

/// How the means of a picture differ from what is expected, in small blocks, in large ones, and by object: three of
/// each region; and over the whole picture.
struct RegionDifferences {
  std::vector<BlockDifference> all, whole;
  std::size_t small = 0, large = 0;  ///< how many of them are of small and of large blocks, which come first
  std::span<const BlockDifference> of_small() const { return {all.data(), small}; }
  std::span<const BlockDifference> of_large() const { return {all.data() + small, large}; }
  std::span<const BlockDifference> of_objects() const { return std::span(all).subspan(small + large); }
  double amount() const { return amount_of(all, all); }
};

/// Whether the small blocks differ by noise alone. The noise of few samples is no normal distribution: so now and then
/// one of them is beyond noise_limit.
bool agrees_in_blocks(const RegionDifferences& regions);
/// Whether all of it does.
bool agrees(const RegionDifferences& regions);

/// How much of the difference is left with `now` in place of `old`, as far as the two differ at all.
double left_by(const RegionDifferences& old, const RegionDifferences& now);
/// How much of a difference is gone; nothing, if `after` is so noisy that little of it could be seen beside its noise.
double gone(const RegionDifferences& before, const RegionDifferences& after);
/// Whether clearly less is left of a difference, where both have the same noise.
bool clearly_closer(const RegionDifferences& a, const RegionDifferences& b);
inline constexpr double clear_improvement = 0.7;  ///< of a difference is left where it has become clearly less

/// Fraction of the light by which the whole may be off without that it is seen.
double unseen_light(const RegionDifferences& regions);

/// Means of linear light over the pixels of an object.
struct ObjectDifference {
  int object = 0;  ///< index into SeenObjects::objects
  int pixels = 0;
  Vec3d image, expected;
};

/// The objects that differ, those with the largest difference first.
std::vector<ObjectDifference> different_objects(const RegionDifferences& regions);

/// The numbers of samples a pixel that a picture's noise may stand for if a program with these samples, `count` of each
/// pixel, has made it, the likeliest first; 0: not known. White makes few samples show as little noise as many, so that
/// there may be several. picture: with the picture without noise as what is expected, and the variance of that.
std::vector<double> likely_counts(const ComparedPixels& picture, const std::vector<BookSample>& samples, int count,
                                  const Regions& regions, double white);

}  // namespace tyndall
