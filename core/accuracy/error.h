#pragma once
#include "core/base/crew.h"
#include "core/film/film.h"

#include <vector>

/// How far a picture is from another, and how far it is likely to be from the truth.
namespace tyndall {

/// Mean over the channels of ((A-B)/2)² / (mean² + 0.01) of one pixel; infinite while a half is empty.
double squared_relative_error(const Film& film, const FilmPixel& pixel);

/// Estimated relative error of a film from its two halves: sqrt(mean over pixels and channels of
/// ((A-B)/2)² / (mean² + 0.01)). Its square estimates relMSE. Infinite while a half is empty. crew: shares the work,
/// null: the caller's thread does it; the answer is the same.
double estimated_relative_error(const Film& film, Crew* crew = nullptr);
/// Whether a few pixels make up so much of a film's error that its estimate means little: paths that are rare and
/// bright have been met in these, and not yet in others. Each pixel's error is taken against the mean of the pixels
/// around it, as its own is lifted by what is wrong with it. True where the standard deviation of the mean of these
/// errors is more than 0.35 of it, in large pictures: where it rests on about 8 pixels.
bool rests_on_few_pixels(const Film& film, Crew* crew = nullptr);
/// The estimated relative error of each pixel of the region from the 7 x 7 pixels around it, less those with an empty
/// half; infinite where none is left.
std::vector<float> pixel_relative_error(const Film& film);

/// The true relative error of each pixel of an image, from the 7 x 7 pixels around it, by the formula of relMSE. Both 3
/// floats a pixel, linear.
std::vector<float> pixel_relative_error(const std::vector<float>& image, const std::vector<float>& reference, int width,
                                        int height);

/// The mean over a film's pixels and channels, and its standard error from the differences of the two halves: they are
/// independent randomisations, so it holds for any sampler, also where pixels show different things.
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
/// Both 3 floats a pixel, linear, of equal and nonzero size.
ImageError image_error(const std::vector<float>& image, const std::vector<float>& reference);
/// relMSE alone, which is quicker.
double relative_mse(const std::vector<float>& image, const std::vector<float>& reference);

}  // namespace tyndall
