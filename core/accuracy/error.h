#pragma once
#include "core/film/film.h"

#include <vector>

/// The error of a picture against another one. For the likely error against the truth see estimate.h.
namespace tyndall {

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

}  // namespace tyndall
