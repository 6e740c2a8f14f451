#pragma once
#include "app/check/book_paths.h"
#include "core/image/image.h"
#include "core/scene/scene.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

/// What a picture shows by one way of reading its file or another; what many samples of each pixel tell of the picture
/// that a program would have shown, and how noisy it is; and how the two differ, by blocks, by objects and as a whole.
namespace tyndall {

/// Three a pixel of a lattice, or of cells of its regions.
using Numbers = std::vector<double>;

/// How numbers of a file stand for light. light: they are light, without limits (floating-point files). From none on
/// they are mistakes.
enum class TransferCurve { light, srgb, power22, gamma2, none, gamma2_twice };

/// One way to read a picture. The first members are what programs choose, the others mistakes.
struct Reading {
  TransferCurve curve = TransferCurve::srgb;
  bool upside_down = false, mirrored = false;  ///< the first row is at the bottom; the first column at the right
  bool swapped = false;                        ///< red and blue have changed places
  /// Whether it holds no mistake.
  bool is_right() const { return curve < TransferCurve::none && !upside_down && !mirrored && !swapped; }
};

/// The readings that are tried for a picture, the right ones or those with mistakes.
std::vector<Reading> readings_of(bool coded, bool right);

/// The pixels of a file before they are read as light.
struct PictureNumbers {
  int width = 0, height = 0;
  /// 3 a pixel, top row first. coded: in [0, 1], in the middle of the interval that the file's number stands for.
  std::vector<float> numbers;
  bool coded = true;        ///< numbers stand for light by a curve, and end at white
  float step = 1 / 256.0f;  ///< how far the numbers may be off by themselves: 8 bits, compression
};

PictureNumbers numbers_of(const PictureFile& picture);

/// Light at the pixels of a lattice.
struct LatticeLight {
  Numbers light;
  Numbers tolerance{};  ///< of a picture: by how much the light may be off because of PictureNumbers::step
  Numbers variance{};   ///< of what is expected: of a pixel's noise, as far as it is known
};
LatticeLight read_pixels(const PictureNumbers& picture, const Lattice& lattice, const Reading& reading);

/// Pairs of numbers: their covariance; of pairs of equal numbers their mean, and the variance of that.
struct Pairs {
  double a = 0, b = 0, products = 0, count = 0;
  void add(double x, double y) { a += x, b += y, products += x * y, ++count; }
  double covariance() const { return count > 1 ? (products - a * b / count) / (count - 1) : 0; }
  double mean() const { return a / count; }
  double variance_of_mean() const { return std::max(covariance(), 0.0) / count; }
};
inline constexpr float Vec3f::*each_channel[] = {&Vec3f::x, &Vec3f::y, &Vec3f::z};

/// What the samples of a pixel tell of one channel.
struct SampleStatistics {
  double mean = 0;
  double variance = 0;  ///< of one sample
  double excess = 0;    ///< the part of a mean of `group` samples that is above white, averaged: what white cuts off
  double noise = 0;     ///< variance of a mean of `group` samples, cut at white
  double common = 0;    ///< covariance of such a mean with that of other samples, which is not cut
  double black = 0;     ///< fraction of such means that are below max_black
};
inline constexpr double max_black = 1e-3;

/// What a picture holds of a pixel's samples: the mean of `group` of them, at most `white`.
struct Exposure {
  int group = 1;
  double white = 1;  ///< infinity for pictures that are not cut
};

/// Of each pixel and channel. count: samples a pixel, from Exposure::group on. Where there are not two groups, noise
/// and common are those of means that are not cut. other: of the same random numbers; null: the samples themselves.
std::vector<SampleStatistics> statistics_of(const std::vector<BookSample>& samples, int count, const Exposure& exposure,
                                            const std::vector<BookSample>* other = nullptr);

/// Sets of pixels whose mean differences are looked at. A cell is a region in one channel.
struct Regions {
  static constexpr std::size_t no_cell = ~std::size_t{0};
  std::vector<int> of_pixel;  ///< -1: the pixel is in none
  int count = 0;
  std::size_t cells() const { return 3 * static_cast<std::size_t>(count); }
  /// The cell of a number; no_cell: its pixel is in none.
  std::size_t cell_of(std::size_t number) const {
    const int region = of_pixel[number / 3];
    return region < 0 ? no_cell : 3 * static_cast<std::size_t>(region) + number % 3;
  }
};

/// Squares of a lattice, `edge` of its pixels wide; those at the right and the lower edge may be smaller.
Regions blocks_of(const Lattice& lattice, int edge);
/// The edge of some 400 blocks, with as many pixels each as statistics need.
int edge_of_blocks(const Lattice& lattice);

/// The object that is seen first through the centre of each pixel of a lattice.
struct SeenObjects {
  struct Object {
    std::string name;            ///< "the sky", `"ball" (glass)`
    std::string kind;            ///< "sky", "glass", "metal", "matt surfaces", "lights", "smoke", "moving objects"
    bool noisy_texture = false;  ///< it has a noise texture, whose veins lie elsewhere in Tyndall
  };
  std::vector<Object> objects;
  std::vector<int> of_pixel;  ///< index into objects
  Regions regions;            ///< of each object the pixels around which it is seen; of a noise texture none
  const Object& at(std::size_t pixel) const { return objects[static_cast<std::size_t>(of_pixel[pixel])]; }
};
SeenObjects seen_objects(const Scene& scene, const Lattice& lattice);

/// Means over the cells of three numbers a pixel, or of members of them.
template <class Number, class Member = std::identity>
Numbers means_of(const Regions& regions, const std::vector<Number>& numbers, Member member = {}) {
  Numbers sums(regions.cells()), counts(regions.cells());
  for (std::size_t at = 0; at < numbers.size(); ++at)
    if (const std::size_t cell = regions.cell_of(at); cell != Regions::no_cell)
      sums[cell] += std::invoke(member, numbers[at]), ++counts[cell];
  for (std::size_t cell = 0; cell < sums.size(); ++cell) sums[cell] /= std::max(counts[cell], 1.0);
  return sums;
}

/// Leaves out the regions in which samples show quite another amount of light than there is: it comes on few paths, so
/// that nobody knows how often white cuts it off.
void leave_out_rare_light(Regions& regions, const std::vector<SampleStatistics>& samples, const LatticeLight& right);

/// What white cuts off of means of many samples, over what it cuts off of means of `count`, of each cell. many: more
/// samples than there are of a pixel, so that those of neighbours are taken together; in the same way for both. 1 where
/// nothing is cut off.
Numbers excess_ratios(const std::vector<BookSample>& samples, int count, double many, const Regions& regions);

/// Fraction of the light of samples that is found after at most so many scattering events, from 0 on.
Numbers light_by_depth(const std::vector<BookSample>& samples);

/// The mean difference in a cell.
struct CellDifference {
  int pixels = 0;         ///< 0: too few to be compared
  double expected = 0;    ///< mean over the pixels
  double difference = 0;  ///< mean of the picture minus that
  double error = 0;       ///< standard error of the mean
  double tolerance = 0;   ///< by how much it may be off without noise
  /// By how much it is off beyond its tolerance and so many errors.
  double beyond(double errors, double of_error) const {
    return std::max(0.0, std::abs(difference) - tolerance - errors * of_error);
  }
};

/// Of each cell. The error is the greater of two: what the scatter of the pixels' differences shows, and what their
/// known variance predicts. The first also holds the noise of the expected light. The second is right where rare bright
/// paths have not happened to be met.
std::vector<CellDifference> differences_of(const LatticeLight& picture, const LatticeLight& expected,
                                           const Regions& regions);

/// Standard errors beyond which a difference is no noise. Errors are estimated, and the noise of few samples is no
/// normal distribution, so that now and then a block of a right picture is beyond, too.
inline constexpr double noise_limit = 5;

/// How much two pictures differ by more than noise.
struct Misfit {
  int blocks = 0;     ///< that were compared
  int different = 0;  ///< in some channel by more than their tolerance and noise_limit errors
};
Misfit misfit_of(std::span<const CellDifference> differences);
/// The difference beyond tolerance and 3 errors, in tolerances, summed over all pixels. The error of each cell is the
/// greater of its own and that of `other`: two amounts that are compared must not differ because one of the pictures is
/// noisier.
double amount_of(std::span<const CellDifference> differences, std::span<const CellDifference> other);

/// The numbers of samples a pixel that a picture's noise may stand for if a program with these samples, `count` of each
/// pixel, has made it, by how far off the noise is; 0: not known. White makes few samples show as little noise as many,
/// so that there may be several. reference: the picture without noise, and the variance of that.
std::multimap<double, double> likely_counts(const LatticeLight& picture, const LatticeLight& reference,
                                            const std::vector<BookSample>& samples, int count, const Regions& regions,
                                            double white);

}  // namespace tyndall
