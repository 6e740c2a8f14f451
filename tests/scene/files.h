#pragma once
#include "core/scene/load.h"
#include "tests/support/scratch.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

/// Helpers of the scene's tests.
namespace tyndall {

/// The scene files of a folder, by name.
inline std::vector<std::filesystem::path> json_files(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

inline Scene parsed(const std::string& text, const std::vector<Override>& overrides = {}) {
  return read_scene(text, "x.json", assets_folder() / "scenes", overrides);
}

/// What reading a text in a folder says, without "x.json: " and the folder's path; empty if it is a scene.
inline std::string complaint(const std::string& text, const std::vector<Override>& overrides = {},
                             const std::filesystem::path& folder = assets_folder() / "scenes") {
  try {
    read_scene(text, "x.json", folder, overrides);
    return "";
  } catch (const SceneError& error) {
    std::string what = error.what(), name = "x.json: ", path = folder.string() + "/";
    for (std::size_t at; (at = what.find(path)) != what.npos;) what.erase(at, path.size());
    return what.starts_with(name) ? what.substr(name.size()) : "without the file's name: " + what;
  }
}

}  // namespace tyndall
