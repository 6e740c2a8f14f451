#pragma once
#include "core/accuracy/error.h"
#include "core/accuracy/noise_test.h"
#include "core/image/image.h"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
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

/// The keys of the limits in files; options spell them with dashes.
inline constexpr std::pair<const char*, std::optional<double> Tolerance::*> tolerance_keys[] = {
    {"max_rmse", &Tolerance::rmse},
    {"max_relmse", &Tolerance::rel_mse},
    {"max_flip", &Tolerance::flip},
    {"max_z", &Tolerance::z}};

/// What is known of two pictures' files.
struct PairFiles {
  std::size_t image_pixels = 0, reference_pixels = 0;  ///< that the files have; more than those compared where cut
  bool has_ppm = false;                                ///< one of the two is a PPM
  std::vector<std::string> remarks{};                  ///< what a user should know of how they were read, a line each
};

/// Takes over what is told of a picture's file, and returns its pixels.
LinearImage take_pixels(PairFiles& files, const std::filesystem::path& name, PictureFile picture);

struct Comparison : PairFiles {
  int width = 0, height = 0;  ///< of what was compared: the pixels that both pictures have
  ImageError error;
  double flip = 0;              ///< mean
  std::vector<float> flip_map;  ///< of each pixel, top row first; 1 where one is not finite
  OutsideError outside{};       ///< of the values that FLIP clips
  /// "FILE: 3 of 256 pixels are not finite, the first at 5,0 (red is nan)" of each of both that has such pixels.
  std::vector<std::string> not_finite{};
  std::optional<NoiseScores> noise{};  ///< where it was asked for, and all values are finite
};

/// Reads and compares two images. ppm: how PPM files are read; noise: also by the noise that both carry. Throws as
/// read_pair() and read_noisy_image() do.
Comparison compare_images(const std::filesystem::path& image, const std::filesystem::path& reference,
                          PpmCurve ppm = PpmCurve::srgb, bool noise = false);

/// One of two pictures that are compared.
struct PairedPicture {
  std::filesystem::path name;
  LinearImage pixels;  ///< those that both have
  Region place{};      ///< where the pixels of the file lie, before they were cut
};
struct PicturePair : PairFiles {
  PairedPicture image, reference;
};

/// Reads two pictures and cuts them to the pixels that both have.
///
/// Two EXR files must have the same display window, pixelAspectRatio and, where both say it, whiteLuminance; their
/// pixels are compared by position. A picture of another format shows the display window of an EXR if it has the
/// size of that; else it must have the size of the data window, and shows that. All others must have the same size.
///
/// Names: see PictureName. ppm: how PPM files are read. Throws UsageError for pictures that do not go together,
/// ImageFileError, NoSuchLayer.
PicturePair read_pair(const std::filesystem::path& image, const std::filesystem::path& reference,
                      PpmCurve ppm = PpmCurve::srgb);

/// Reads a picture that others are measured against: an EXR is cut to its display window, which it must fill. Throws
/// UsageError if it does not or if its pixels are not square, ImageFileError, NoSuchLayer.
PictureFile read_whole_picture(const std::filesystem::path& name);

/// Reads a picture with its noise: an EXR with the film of Tyndall, else with a layer "Variance"; or a PFM, FILE.pfm,
/// with its standard errors beside it in FILE.error.pfm. place: where its pixels lie, of its size. Throws UsageError,
/// which says what to pass, for all others, and for a film with fewer than 2 samples in a pixel; ImageFileError.
NoisyImage read_noisy_image(const std::filesystem::path& name, const Region& place);

/// Compares the two pictures of a pair.
Comparison compare_pair(PicturePair pair);

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
