#pragma once
#include "app/window/document/document.h"
#include "core/scene/load.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

/// From scene files to documents, and back.
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

}  // namespace tyndall
