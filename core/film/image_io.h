#pragma once
#include "core/film/film.h"
#include "core/film/tonemap.h"

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

/// Image files. Every writer writes a whole file or none: it writes beside the target and renames, and removes what it
/// began when something fails. All throw ImageFileError.
namespace tyndall {

/// An image file that cannot be read or written. One line: "FILE: why".
struct ImageFileError : std::runtime_error {
  using runtime_error::runtime_error;
};

/// Linear Rec.709 RGB, 3 floats a pixel, top row first.
struct LinearImage {
  int width = 0, height = 0;
  std::vector<float> rgb;
};

/// A further picture of the same size for EXR: "albedo" (R, G, B), "normal" (X, Y, Z), "depth" (Z).
struct Layer {
  std::string name;
  std::vector<std::string> channels;
  std::vector<float> values;  ///< channels interleaved
};

/// What PNG and EXR carry so that the picture can be opened again as the scene that made it: the scene file's text.
struct Embedded {
  std::string scene;  ///< JSON; empty: none
  std::string stats;  ///< JSON; empty: none
};

void write_png(const std::filesystem::path& file, const LinearImage& image, double exposure, ToneCurve curve,
               const Embedded& embedded);
/// Bottom row first, scale -1.0 (little endian). Carries nothing hidden.
void write_pfm(const std::filesystem::path& file, const LinearImage& image);
/// Radiance RGBE. Carries nothing hidden.
void write_hdr(const std::filesystem::path& file, const LinearImage& image);
/// Float RGB, layers, the film itself in channels film.*, data window = the film's region. Throws if built without OpenEXR.
void write_exr(const std::filesystem::path& file, const Film& film, const std::vector<Layer>& layers,
               const Embedded& embedded);
bool has_openexr();

/// PNG (8-bit, sRGB decoded to linear), JPEG, PFM, HDR, EXR by content.
LinearImage read_image(const std::filesystem::path& file);
/// The film in an EXR that Tyndall wrote; nothing if it holds none.
std::optional<Film> read_film(const std::filesystem::path& file);
/// The scene text in a PNG or EXR that Tyndall wrote; nothing if it holds none or is no such file.
std::optional<std::string> read_embedded_scene(const std::filesystem::path& file);

/// 8-bit RGB, top row first, as it stands in the file: for textures. channels: 3.
struct Rgb8Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};
Rgb8Image read_rgb8(const std::filesystem::path& file);

/// True for an ending that write_* knows: .png .exr .pfm .hdr (any case).
bool is_image_output(const std::filesystem::path& file);

}  // namespace tyndall
