#pragma once
#include "core/accuracy/noise_test.h"
#include "core/image/image.h"

#include <filesystem>
#include <string>
#include <vector>

/// Pictures from files, placed so that they can be compared pixel by pixel.
namespace tyndall {

/// The pixels that two pictures both have.
struct PicturePair {
  LinearImage image, reference;                        ///< of the same size
  Region image_place{}, reference_place{};             ///< where the pixels of the files lie, before they were cut
  std::size_t image_pixels = 0, reference_pixels = 0;  ///< that the files have; more than those compared where cut
  bool has_ppm = false;                                ///< one of the two is a PPM
  std::vector<std::string> remarks{};                  ///< what a user should know of how they were read, a line each
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

}  // namespace tyndall
