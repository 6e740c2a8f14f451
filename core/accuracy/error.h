#pragma once
#include "core/film/film.h"
#include "core/image/image.h"

#include <cstddef>
#include <string>
#include <vector>

/// The error of a picture against another one, and its values that are not finite: NaN, which equals nothing, not even
/// itself, and infinities. For the likely error against the truth see estimate.h.
namespace tyndall {

inline constexpr double floor_of_square = 0.01;  ///< added to squared levels: keeps black pixels from dominating

/// For each pixel the root of the mean of these squares over the 7 x 7 pixels around it. Infinite squares are left out;
/// the result is infinite where all are infinite.
std::vector<float> root_window_means(const std::vector<double>& squares, int width, int height);

/// The true relative error of each pixel of an image, from the 7 x 7 pixels around it, by the formula of relMSE. Both
/// images: 3 floats a pixel, linear.
std::vector<float> pixel_relative_error(const std::vector<float>& image, const std::vector<float>& reference, int width,
                                        int height);

/// The mean over a film's pixels and channels, and its standard error from the differences of the two halves. The
/// halves are independent randomisations, so this holds for any sampler, also where pixels show different things.
struct FilmMean {
  double mean = 0;
  double error = 0;  ///< infinite while a half of a pixel is empty
};
FilmMean film_mean(const Film& film);

/// Errors of an image against a reference. Means over pixels and channels.
struct ImageError {
  double mse = 0, rmse = 0;
  double rel_mse = 0;  ///< (x - ref)² / (ref² + 0.01): depends on the unit of radiance
  double psnr = 0;     ///< dB, of the sRGB images clipped to [0, 1]; infinite for equal images
  Vec3d mean_image, mean_reference;
};
/// Both images: 3 floats a pixel, linear, of equal and nonzero size.
ImageError image_error(const std::vector<float>& image, const std::vector<float>& reference);
/// relMSE alone, which is quicker.
double relative_mse(const std::vector<float>& image, const std::vector<float>& reference);

/// relMSE of the values that are outside [0, 1] in the image or in the reference. FLIP and PSNR, which clip, cannot see
/// differences there.
struct OutsideError {
  double rel_mse = 0;      ///< 0 if there are no such values
  std::size_t values = 0;  ///< number of such values, at most three a pixel
};
/// Values that are not finite are left out.
OutsideError outside_error(const std::vector<float>& image, const std::vector<float>& reference);

/// The difference that an eye sees when two pictures are shown in turn (FLIP): one number for each pixel, top row
/// first, in [0, 1]; 0 where both look the same. The formula is symmetric: swapping image and reference changes no bit.
/// Both are linear Rec.709, 3 floats a pixel, and are shown as sRGB clipped to [0, 1]; values that are not a number
/// count as black. 67 pixels a degree: a screen of 0.7 m with 3840 pixels seen from 0.7 m. Andersson, Nilsson,
/// Akenine-Möller, Oskarsson, Åström, Fairchild, FLIP: A Difference Evaluator for Alternating Images, Proc. ACM Comput.
/// Graph. Interact. Tech. 3 (2020).
std::vector<float> flip_map(const std::vector<float>& image, const std::vector<float>& reference, int width,
                            int height);

/// Whether the pixel of that index, top row first, is finite in all channels.
bool is_finite(const LinearImage& image, std::size_t pixel);

/// "3 of 256 pixels are not finite, the first at 5,0 (red is nan)"; empty if all values are finite.
std::string not_finite_text(const LinearImage& image);

/// Whether two pictures differ by more than their noise. They are compared block by block, because a bias too small to
/// be seen in one pixel shows in the mean of many. z of a block: the difference between the mean grey values, divided
/// by its standard error, which follows from the halves of both films.
struct BlockScores {
  int blocks = 0;          ///< number of compared blocks; blocks that are equal and without noise are left out
  double mean_square = 0;  ///< of z; about 1 if the pictures differ by noise alone
  double maximum = 0;      ///< largest mean_square that noise explains: 4 standard deviations above its expected value
  double worst = 0;        ///< largest |z|; infinite if a block without noise differs
  bool noise() const { return mean_square <= maximum && worst < 1e300; }
};

/// Both films must have the same region, and samples in both halves of every pixel; otherwise there are no blocks.
/// edge: of a block, in pixels; a multiple of 16 keeps groups whole (film/groups.h).
BlockScores block_scores(const Film& a, const Film& b, int edge = 16);

}  // namespace tyndall
