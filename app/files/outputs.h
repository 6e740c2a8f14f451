#pragma once
#include "core/clean/clean.h"
#include "core/image/image_io.h"
#include "core/scene/scene.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

/// The files that a command writes.
namespace tyndall {

/// How image files are written, where their names do not say it.
struct ImageForm {
  std::string
      format;  ///< of what goes to standard output, the file "-": png, exr, pfm, hdr or ppm; empty: nothing goes there
  bool exr_film = true;           ///< whether EXR files hold the film itself, which merge, denoise and --resume need
  PpmCurve ppm = PpmCurve::srgb;  ///< how PPM files are written
};

/// Throws UsageError for an ending that is no image's, EXR in a build without it, a file named twice, or --gamma2
/// without a PPM; and if a
/// format for standard output is missing, or given though no image goes there, or if the figures (`stats`) go there,
/// too.
void check_image_names(const std::vector<std::filesystem::path>& files, const ImageForm& form = {},
                       const std::filesystem::path& stats = {});

/// What says the format of an image file: the ending of its name, or of standard output the form's. In small letters,
/// with its dot, for example ".png".
std::string image_ending(const std::filesystem::path& file, const ImageForm& form);

/// True for names that end in .exr (any case).
bool is_exr(const std::filesystem::path& file);

/// True for standard output ("-") and named pipes, which can be written once.
bool is_stream(const std::filesystem::path& file);

/// The file among the outputs of a render that films are kept in: an EXR with its film that is an ordinary file, there
/// or not yet; empty if there is none.
std::filesystem::path kept_film(const std::vector<std::filesystem::path>& outputs, const ImageForm& form);

/// Throws IoError unless the file could be written now: its folder exists and takes new files. Leaves nothing behind.
void check_can_write(const std::filesystem::path& file);

/// A file that a command is to write, and the option that names it.
struct Output {
  std::string option;
  std::filesystem::path file;
};
/// The files of an option that may be repeated.
std::vector<Output> outputs_of(const std::string& option, const std::vector<std::filesystem::path>& files);
/// Throws UsageError if an output is one of the files that the command reads, or two outputs are one file, also under
/// another name or through a link. "" and "-" are no files.
void check_outputs(const std::vector<Output>& outputs, const std::vector<std::filesystem::path>& inputs);

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

/// Writes all files that can be written; returns what went wrong, a line each.
std::vector<std::string> write_images(const Picture& picture, const std::vector<std::filesystem::path>& files);

/// Writes text as a whole file or not at all. Throws ImageFileError.
void write_text_file(const std::filesystem::path& file, const std::string& text);

}  // namespace tyndall
