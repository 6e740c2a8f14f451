#pragma once
#include "core/base/error.h"
#include "core/image/image_io_exr.h"
#include "core/image/image_io_file.h"

#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>

#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// How EXR files are opened, and which of their channels are a picture: for the files of this folder that include
/// OpenEXR.
namespace tyndall {

/// Runs `read` on the opened EXR. Whatever goes wrong becomes an ImageFileError that names the file.
template <class Read>
auto with_exr(const std::filesystem::path& file, Read read) {
  try {
    check_exr(file);
    Imf::MultiPartInputFile exr(file.string().c_str());
    return read(exr);
  } catch (const ImageFileError&) {
    throw;
  } catch (const std::bad_alloc&) {
    cannot_read(file, "not enough memory" + memory_limit_text());
  } catch (const std::exception& error) {
    cannot_read(file, error.what());
  }
}

/// The channels to read, and where their values go.
struct ExrTarget {
  Imf::FrameBuffer buffer;
  Imath::Box2i window;

  void add(const std::string& name, Imf::PixelType type, void* first, std::size_t stride) {
    buffer.insert(name, Imf::Slice::Make(type, first, window, stride));
  }
  void read(Imf::MultiPartInputFile& exr, int number) {
    Imf::InputPart part(exr, number);
    part.setFrameBuffer(buffer);
    part.readPixels(window.min.y, window.max.y);
  }
};

/// The size of a data window.
inline std::pair<int, int> size_of(const std::filesystem::path& file, const Imath::Box2i& window) {
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
  const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
  check_readable(file, width, height);
  return {static_cast<int>(width), static_cast<int>(height)};
}

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
