#pragma once
#include "core/base/error.h"
#include "core/scene/scene.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

/// The scene file: JSON with comments. app/cli/README.md shows the format, assets/scene.schema.json describes it.
namespace tyndall {

/// One override of a value in the file's JSON, applied before validation: pointer "/materials/gold/fuzz", value JSON
/// or, if it is not JSON, a string.
struct Override {
  std::string pointer, value;
};

/// Reads and checks a scene. name: what errors call it (usually the file's name). folder: where relative texture files
/// are. Throws SceneError for everything that is wrong with it, also for textures that cannot be read, and for keys
/// that have no place in it.
Scene read_scene(std::string_view text, const std::string& name, const std::filesystem::path& folder,
                 const std::vector<Override>& overrides = {});

/// The sky of a picture file. folder: that of the scene, from which the file is named if it lies in it. Throws
/// SceneError.
SkyPicture sky_of_file(const std::filesystem::path& file, const std::filesystem::path& folder);

/// A valid scene in normal form: every value that is required or not its default, keys in the format's order. Reading
/// it gives an equal scene. Image files are written as they stand in the scene: see move_textures().
std::string write_scene(const Scene& scene);

/// Comment lines at the top of a scene file (without "//"), for `inspect`.
std::vector<std::string> leading_comments(std::string_view text);

}  // namespace tyndall
