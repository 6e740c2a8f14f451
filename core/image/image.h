#pragma once
#include "core/film/film.h"

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

/// Images in memory, and what is written into files beside them.
namespace tyndall {

/// An image file that cannot be read or written. One line: "FILE: why".
struct ImageFileError : std::runtime_error {
  using runtime_error::runtime_error;
};

/// A picture's name that asks for a layer which the file has not. One line with the layers that there are.
struct NoSuchLayer : ImageFileError {
  using ImageFileError::ImageFileError;
};

/// What an EXR says of where its pixels lie and what they mean. Pictures of other formats say nothing of the kind.
struct ImageFrame {
  Region display;                          ///< the picture that is meant; coordinates may be negative
  Region data;                             ///< the pixels that the file has: a part of it, or more (overscan)
  float pixel_aspect = 1;                  ///< width of a pixel over its height
  std::optional<float> white_luminance{};  ///< cd/m² of RGB (1, 1, 1), where the file says so
};

/// Linear Rec.709 RGB, 3 floats a pixel, top row first.
struct LinearImage {
  int width = 0, height = 0;
  std::vector<float> rgb;
  std::optional<ImageFrame> frame{};  ///< of an EXR; width and height are those of its data
};

/// A further picture of the same size for EXR, for example "Albedo" (R, G, B), "Ns" (X, Y, Z) or "Depth" (Z).
struct Layer {
  std::string name;
  std::vector<std::string> channels;
  std::vector<float> values;  ///< channels interleaved
  bool half = false;          ///< 16 bits a value are enough in the file: 11 significant ones, up to 65504
};

/// What a film's file says about how the film was made. Films may only be gone on with by the same version and
/// instruction set, and with the same pixels of textures and sky: others would mix bits.
struct FilmLabel {
  std::string version;      ///< of the program; "": not known; "several": of merged parts that differ
  std::string isa;          ///< instruction set of the kernels; likewise
  bool unfinished = false;  ///< more samples were asked for than the film has: a checkpoint, or an interrupted render
  std::string contents{};   ///< see contents_hash(); "": the scene has no pictures, or the film is older than this
  bool operator==(const FilmLabel&) const = default;
};

/// What PNG and EXR carry so that the picture can be opened again as the scene that made it: the scene file's text.
struct Embedded {
  std::string scene;  ///< JSON; empty: none
  std::string stats;  ///< JSON; empty: none
  FilmLabel label{};  ///< for EXR; of a PNG `contents` alone
  bool film = true;   ///< whether an EXR holds the film itself
};

/// The kinds of image files. `ppm` also stands for greys (P2, P5).
enum class ImageKind { unknown, png, jpeg, bmp, tga, ppm, pfm, hdr, exr };

/// How the numbers of a PPM stand for light: by sRGB's curve, or as the programs of the "Ray Tracing in One Weekend"
/// books write them, which take the square root.
enum class PpmCurve { srgb, gamma2 };

/// A picture as it was read from a file.
struct PictureFile {
  LinearImage image;
  ImageKind kind = ImageKind::unknown;
  int bits = 32;           ///< of each number in the file, rounded up to 8, 16 or 32; 32: floating point
  bool has_alpha = false;  ///< some pixel is not opaque, which is not looked at: its colour is read as it stands
  /// What a user should know of how the file was read, a line each: "FILE: …".
  std::vector<std::string> remarks;
};

}  // namespace tyndall
