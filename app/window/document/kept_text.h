#pragma once
#include "app/window/document/document.h"
#include "core/scene/load.h"

#include <filesystem>
#include <functional>
#include <string>

/// Edits that were not saved, as the text of a file.
namespace tyndall {

/// A scene file with an edited scene. Its first lines, comments, say what it is an edit of, and of which text. folder:
/// where the file will be; the paths of textures are spelt for it.
std::string kept_text(const Scene& scene, const Origin& origin, const std::filesystem::path& folder);
struct Kept {
  Document document;
  bool file_changed = false;  ///< the file of the scene has been given another text since the edits were made
};
/// What is in such a file, which read() reads as load_scene() does. Where the scene that was edited cannot be read any
/// more, all of it counts as edited. Throws SceneError if the file is broken, IoError if it cannot be read.
Kept read_kept(const std::filesystem::path& file, const std::function<LoadedScene(const std::string& what)>& read);
/// What the file says it is an edit of: Origin::what. Empty if it says nothing.
std::string kept_what(const std::filesystem::path& file);

}  // namespace tyndall
