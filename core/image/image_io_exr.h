#pragma once
#include "core/base/error.h"
#include "core/image/image_io.h"
#include "core/image/image_io_file.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>

#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// How EXR files are opened, which of their channels are a picture, and how they carry a film: for the files of this
/// folder that include OpenEXR.
namespace tyndall {

/// One channel of a film in an EXR: a 32-bit word of FilmPixel or EmissionSums.
struct FilmChannel {
  std::string name;    ///< for example film.A.R.high0: half A or B, channel, limb, word (0: the limb's low half)
  const void* first;   ///< the word in the film's first pixel
  std::size_t stride;  ///< from one pixel to the next, bytes
};
/// Those of all sums and counts of a film that has pixels, and of its emission where it has any.
std::vector<FilmChannel> film_channels(const Film& film);

/// Refuses an EXR whose header asks for more memory than a whole file of its size could need: OpenEXR itself believes
/// what attributes, windows and tiles say, and takes the memory before it looks for the bytes. Throws ImageFileError.
void check_exr(const std::filesystem::path& file);

/// What users are told about pixels with many depths.
inline constexpr const char* deep_data = "found deep data (many depths a pixel), expected a flat picture";

/// The version of the form in which films are written. 0 had neither label nor planned rounds. All up to this one are
/// read.
inline constexpr int film_format = 1;

// Names of the header's attributes.
namespace exr_name {
inline constexpr const char* scene = "tyndall:scene";
inline constexpr const char* stats = "tyndall:stats";
inline constexpr const char* contents = "tyndall:contents";          // FilmLabel::contents; absent: ""
inline constexpr const char* width = "tyndall:width";                // of the full image
inline constexpr const char* height = "tyndall:height";              // of the full image
inline constexpr const char* first_sample = "tyndall:first_sample";  // a double, to hold all of 32 bits
inline constexpr const char* quantum = "tyndall:unit";
inline constexpr const char* cut_throughput = "tyndall:cut_throughput";  // both limbs in decimal, high first
inline constexpr const char* film_format = "tyndall:film_format";        // an int; absent: 0
inline constexpr const char* unfinished = "tyndall:unfinished";          // an int, 0 or 1
inline constexpr const char* version = "tyndall:version";
inline constexpr const char* isa = "tyndall:isa";
inline constexpr const char* planned = "tyndall:planned";    // Film::planned as it is in memory; absent: empty
inline constexpr const char* checksum = "tyndall:checksum";  // see checksum_text(): 16 hex digits
}  // namespace exr_name

/// The attribute `checksum` for a film, the scene's text and the label.
std::string checksum_text(const Film& film, const Embedded& embedded);

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

  void add(const std::string& name, Imf::PixelType type, const void* first, std::size_t stride) {
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
