#pragma once
#include "core/accuracy/error.h"
#include "core/accuracy/noise_test.h"
#include "core/image/image.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// How far a picture is from the one it should look like, and whether that is too far.
namespace tyndall {

/// The largest errors that pass; absent: not looked at.
struct Tolerance {
  std::optional<double> rmse, rel_mse, flip;
  std::optional<double> z{};  ///< standard errors, see NoiseScores
  bool none() const { return !rmse && !rel_mse && !flip && !z; }
  bool operator==(const Tolerance&) const = default;
};

struct Comparison {
  int width = 0, height = 0;  ///< of what was compared: the pixels that both pictures have
  ImageError error;
  double flip = 0;                                     ///< mean
  std::vector<float> flip_map;                         ///< of each pixel, top row first; 1 where one is not finite
  std::size_t image_pixels = 0, reference_pixels = 0;  ///< that the pictures have
  bool has_ppm = false;                                ///< one of the two is a PPM
  /// What a user should know of how the files were read, a line each.
  std::vector<std::string> remarks{};
  OutsideError outside{};  ///< of the values that FLIP clips
  /// "FILE: 3 of 256 pixels are not finite, the first at 5,0 (red is nan)" of each of both that has such pixels.
  std::vector<std::string> not_finite{};
  std::optional<NoiseScores> noise{};  ///< where it was asked for, and all values are finite
};

/// Reads and compares two images. ppm: how PPM files are read; noise: also by the noise that both carry. Throws as
/// read_pair() and read_noisy_image() do.
Comparison compare_images(const std::filesystem::path& image, const std::filesystem::path& reference,
                          PpmCurve ppm = PpmCurve::srgb, bool noise = false);

struct PicturePair;
/// Compares two pictures of a pair that was read from files of these names.
Comparison compare_pair(PicturePair pair, const std::filesystem::path& image, const std::filesystem::path& reference);

/// Throws UsageError if --gamma2 was given and no PPM was read.
void check_gamma2(PpmCurve ppm, bool has_ppm);

/// "600 that both have, of 2048 in the image and 600 in the reference"; "" where all pixels were compared.
std::string overlap_text(const Comparison& comparison);

/// What the noise says in a line, without its end: "means 0.4, blocks 1.9, outliers 0 standard errors, …".
std::string noise_text(const NoiseScores& scores);

/// Why the pictures do not pass: values that are not finite, which are equal to nothing, whatever the limits are; and
/// what is too large, each like "RMSE is 0.2, expected at most 0.1". An error that is not a number always is.
std::vector<std::string> too_large(const Comparison& comparison, const Tolerance& limits);

/// Throws UsageError "FILE: found that 3 of 256 pixels are not finite, …" for a picture with such values.
void check_finite(const std::filesystem::path& file, const LinearImage& image);

}  // namespace tyndall
