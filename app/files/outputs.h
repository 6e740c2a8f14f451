#pragma once
#include "core/files/film_files.h"
#include "core/image/image_io.h"
#include "core/image/whole_file.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

/// The files that a command writes.
namespace tyndall {

/// Throws UsageError for an ending that is no image's, EXR in a build without it, a file named twice, or --gamma2
/// without a PPM; and if a format for standard output is missing, or given though no image goes there, or if the
/// figures (`stats`) go there, too.
void check_image_names(const std::vector<std::filesystem::path>& files, const ImageForm& form = {},
                       const std::filesystem::path& stats = {});

/// The file among the outputs of a render that films are kept in: an EXR with its film that is an ordinary file, there
/// or not yet; empty if there is none.
std::filesystem::path kept_film(const std::vector<std::filesystem::path>& outputs, const ImageForm& form);

/// Throws IoError unless the file could be written now: its folder exists, and takes new files, or the file can be
/// written into. Leaves nothing behind. Returns how it will be written.
FilePlace check_can_write(const std::filesystem::path& file);

/// Where the film of a render is, while it is rendered and at its end.
struct FilmPlace {
  std::filesystem::path output;      ///< see kept_film(); empty: the render keeps no film
  std::filesystem::path unfinished;  ///< where checkpoints go: to the output itself; to NAME.unfinished.exr beside it
                                     ///< where that cannot be replaced; empty: nowhere
  /// The file beside the output; empty: there is none.
  std::filesystem::path beside() const { return unfinished == output ? std::filesystem::path() : unfinished; }
};
FilmPlace film_place(const std::vector<std::filesystem::path>& outputs, const ImageForm& form);

/// A file that a command is to write, and the option that names it.
struct Output {
  std::string option;
  std::filesystem::path file;
};
/// The files of --output and --stats.
std::vector<Output> outputs_of(const std::vector<std::filesystem::path>& files,
                               const std::filesystem::path& stats = {});
/// Throws IoError unless all of them could be written now, see above. "" and "-" are no files.
void check_can_write(const std::vector<Output>& outputs);
/// Throws UsageError if an output is one of the files that the command reads, or two outputs are one file, also under
/// another name or through a link. "" and "-" are no files.
void check_outputs(const std::vector<Output>& outputs, const std::vector<std::filesystem::path>& inputs);

/// Writes all files that can be written; returns what went wrong, a line each. What cannot be written goes elsewhere,
/// see write_or_rescue().
std::vector<std::string> write_images(const Picture& picture, const std::vector<std::filesystem::path>& files);

/// Writes text as a whole file or not at all. Throws ImageFileError.
void write_text_file(const std::filesystem::path& file, const std::string& text);

/// Calls write(file). Where that fails, what was computed is not to be lost: write() is called with a new name beside
/// the file, NAME.new.ENDING, and if that fails, too, with the file's name in a folder of its own among the temporary
/// files. Then it throws ImageFileError, which says what went wrong with the file, and where it is now. Streams, and
/// what memory does not suffice for, are not written elsewhere.
void write_or_rescue(const std::filesystem::path& file,
                     const std::function<void(const std::filesystem::path& file)>& write);
/// The same for text; "-" is standard output.
void write_text_or_rescue(const std::filesystem::path& file, const std::string& text);

/// Calls write(), for one of several outputs. Where that fails, says so in a line and returns false, so that the others
/// are still written.
bool written_or_told(const std::function<void()>& write);

/// Within a handler: says in a line what was thrown, and returns the exit code for it: 2 where the user is at fault, 3
/// where input or output fails, 128 and the number of the signal that ended it.
int told_exit_code();

}  // namespace tyndall
