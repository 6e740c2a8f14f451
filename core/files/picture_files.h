#pragma once
#include "core/clean/clean.h"
#include "core/image/image_io.h"
#include "core/scene/scene.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

/// Pictures as files of any kind.
namespace tyndall {

/// How image files are written, where their names do not say it.
struct ImageForm {
  std::string
      format;  ///< of what goes to standard output, the file "-": png, exr, pfm, hdr or ppm; empty: nothing goes there
  bool exr_film = true;           ///< whether EXR files hold the film itself, which merge, denoise and --resume need
  PpmCurve ppm = PpmCurve::srgb;  ///< how PPM files are written
};

/// What says the format of an image file: the ending of its name, or of standard output the form's. In small letters,
/// with its dot, for example ".png".
std::string image_ending(const std::filesystem::path& file, const ImageForm& form);

/// True for names that end in .exr (any case).
bool is_exr(const std::filesystem::path& file);

/// What becomes image files.
struct Picture {
  const Film& film;
  const LinearImage& image;                                             ///< the film's means
  Display display;                                                      ///< for PNG and PPM
  std::function<Embedded(const std::filesystem::path& file)> embedded;  ///< for PNG and EXR
  std::function<std::vector<Layer>()> layers;  ///< for EXR, made only when needed; may be empty
  const CleanPicture* clean = nullptr;         ///< shown in place of the means, in EXR beside them; null: none
  ImageForm form{};
};

/// Writes the picture as a whole file, or throws ImageFileError and writes nothing. kind: see image_ending(); the
/// file's own where it is left out. Throws UsageError for an ending that is no image's.
void write_picture(const Picture& picture, const std::string& kind, const std::filesystem::path& file);
void write_picture(const Picture& picture, const std::filesystem::path& file);

}  // namespace tyndall
