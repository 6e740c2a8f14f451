#pragma once
#include "app/window/document/document.h"
#include "core/film/film.h"
#include "core/scene/load.h"

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

/// From scene files to documents, and back; and the film of a snapshot that is opened again: its picture goes on from
/// where it was.
namespace tyndall {

/// A loaded scene as a document without edits.
Document document_of(const LoadedScene& loaded);

/// Whether a scene file's text has comments, // or /* */.
bool has_comments(std::string_view text);

/// Writes the document's scene to a file and returns where it comes from now. Image textures are respelt for the new
/// place. Throws ImageFileError or IoError: one line.
std::shared_ptr<const Origin> save_document(const Document& document, const std::filesystem::path& file);

/// Whether the file holds something else than when it was read or written last, readable or not. Reads it.
bool file_differs(const Origin& origin);

/// The files that the document shows, to be watched: its scene file or the program's source files, if that is where it
/// came from, and its textures.
/// None of standard input, which cannot be read again.
std::vector<std::filesystem::path> watched_files(const Document& document);

/// "showroom" of "showroom.json" or "showroom-003.png": what snapshots and copies are named after.
std::string stem_of(const std::string& title);

/// What the window calls a file: its name, as one line.
std::string title_of(const std::filesystem::path& file);

struct OpenedFilm {
  std::shared_ptr<Film> film;  ///< null: the picture starts over, or it is no snapshot
  std::string remark;          ///< what the user is told of it; "": nothing
};

/// Reads the film of a scene that was loaded from an image. It is only of use if it is whole and its samples are those
/// that this program would take with these kernels, so that nobody can tell that the picture was ever closed; else the
/// word says what it lacks. isa: of the kernels; "": the best. Never throws.
OpenedFilm read_opened_film(const LoadedScene& loaded, const std::string& isa);

}  // namespace tyndall
