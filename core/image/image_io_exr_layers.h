#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <OpenEXR/ImfForward.h>

/// Which channels of an EXR make up the picture that is asked for: for the files of this folder that include OpenEXR.
namespace tyndall {

/// What the channels of a layer mean.
enum class ExrColour {
  rgb,               ///< red, green, blue
  vector,            ///< X, Y, Z: numbers that are no colour, shown as red, green, blue
  luminance_chroma,  ///< Y, RY = (R - Y) / Y, BY = (B - Y) / Y
  grey               ///< one channel
};

struct ExrLayer {
  int part = 0;  ///< of the file, from 0 on
  ExrColour colour = ExrColour::rgb;
  std::string prefix;                 ///< of the channels' names, such as "ViewLayer.Combined"; "": none
  std::vector<std::string> channels;  ///< whole names: one for grey, else three
};

/// The layer of that name. Without a name: the picture of the first part that has colour (R, G and B, or Y) without a
/// layer's name before it, or, in files of several parts, with the part's own name.
///
/// A layer is known by its channels' prefix ("ViewLayer.Combined"), by its part's name, by both ("beauty.albedo"), or
/// by the name of its view; and a single channel by its whole name ("Depth.Z"). What one of these names means is what
/// the first part says that knows it.
///
/// Throws NoSuchLayer for an unknown name, ImageFileError for a file without colour; both list what there is.
ExrLayer find_exr_layer(const std::filesystem::path& file, const Imf::MultiPartInputFile& exr,
                        const std::optional<std::string>& name);

}  // namespace tyndall
