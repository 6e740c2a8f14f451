#include "app/files/open_scene.h"

#include "app/book/load_program.h"
#include "app/text/standard_streams.h"
#include "core/base/error.h"
#include "core/scene/check.h"

#include <system_error>

namespace tyndall {
namespace {

constexpr const char* expected_no_program =
    "a scene file or an image; a program is compiled and run only where it is named on the command line";

/// Programs name images by whole paths, as they run elsewhere. Those below the folder are named from there, so that the
/// scene can be moved with them.
Scene name_textures_from(const std::filesystem::path& folder, Scene scene) {
  std::error_code error;
  const std::filesystem::path whole = std::filesystem::canonical(folder, error);
  for (Texture& texture : scene.textures) {
    auto* image = std::get_if<Image>(&texture.kind);
    if (!image || error) continue;
    const std::filesystem::path below = std::filesystem::path(image->file).lexically_relative(whole);
    if (!below.empty() && *below.begin() != "..") image->file = below.string();
  }
  return scene;
}

/// The scene that a program writes.
LoadedScene load_program_scene(const SceneRequest& request) {
  const std::filesystem::path file = request.what;
  if (!request.program.allowed) throw SceneError(request.what, "a program", expected_no_program);
  std::error_code error;
  if (!std::filesystem::exists(file, error)) throw SceneError(request.what, "no such file", "a C++ source file");
  ProgramRequest parts;
  parts.sources = {{file}, request.program.include_folders};
  const auto& more = request.program.more_files;
  parts.sources.files.insert(parts.sources.files.end(), more.begin(), more.end());
  parts.build = request.program.build;
  parts.go_on = request.program.go_on;
  parts.watch_signals = !parts.go_on;
  const ProgramScene made = load_program(parts);
  for (const std::string& note : made.notes)
    if (!request.program.told) complain(note);
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  LoadedScene loaded = load_scene_text(made.json, request.what, folder, request.overrides);
  loaded.scene = name_textures_from(folder, std::move(loaded.scene));
  loaded.sources = made.files;
  loaded.files.insert(loaded.files.begin(), made.files.begin(), made.files.end());
  return loaded;
}

}  // namespace

LoadedScene open_scene(const SceneRequest& request) {
  LoadedScene loaded =
      is_program(request.what) ? load_program_scene(request) : load_scene(request.what, request.overrides);
  if (request.size) loaded.scene.width = request.size->width, loaded.scene.height = request.size->height;
  apply(request.render, loaded.scene.render);
  apply(request.display, loaded.scene.display);
  if (const auto error = check(loaded.scene))
    throw SceneError(loaded.name, error->where, error->found, error->expected);
  for (const std::string& remark : texture_remarks(loaded.scene))
    if (!request.program.told) complain(remark);
  return loaded;
}

}  // namespace tyndall
