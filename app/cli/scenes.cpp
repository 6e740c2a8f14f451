#include "app/cli/requests.h"
#include "app/export/foreign_scene.h"
#include "app/text/standard_streams.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/image/image_io.h"

#include <algorithm>

namespace tyndall {
namespace {

/// What a scene is, in one line: the first sentence of the comments at its top, else its name.
std::string about(const BuiltIn& scene) {
  if (scene.about.empty()) return scene.title;
  constexpr std::size_t longest = 110;
  std::string sentence = scene.about.substr(0, scene.about.find(". "));
  if (sentence.back() == '.') sentence.pop_back();
  return printable(shortened(sentence, longest));
}

/// In the format that the ending of the output says; of Tyndall's own the text alone.
ForeignFile converted(const Scene& scene, const std::string& name, const std::filesystem::path& output) {
  const std::string ending = lower_case(output.extension().string());
  if (ending == ".pbrt") return pbrt_file(scene, name, output.string());
  if (ending == ".xml") return mitsuba_file(scene, name, output.string());
  if (ending == ".py") return blender_file(scene, name, output.string());
  return {write_scene(scene), {}};
}

}  // namespace

int run_scenes(const CommandRequest&) {
  const std::vector<BuiltIn> scenes = built_in_scenes();
  if (scenes.empty()) throw IoError("no built-in scenes were found (TYNDALL_ASSETS names the folder that has scenes/)");
  std::size_t width = 0;
  for (const BuiltIn& scene : scenes) width = std::max(width, scene.name.size());
  std::string text;
  for (const BuiltIn& scene : scenes) text += fmt::format("{:<{}}{}\n", scene.name, width + 2, about(scene));
  write_standard_output(text);
  return 0;
}

int run_convert(const CommandRequest& command) {
  const LoadedScene loaded = open_scene(command.scene);
  const std::filesystem::path folder = command.output.parent_path();  // of "-", too: none
  const ForeignFile file = converted(move_textures(loaded.scene, loaded.folder, folder), loaded.name, command.output);
  std::vector<Output> outputs{{"--output", command.output}};
  for (const auto& [name, pixels] : file.pictures) outputs.push_back({"--output", folder / name});
  for (const auto& [name, mesh] : file.meshes) outputs.push_back({"--output", folder / name});
  check_outputs(outputs, loaded.files);
  check_can_write(outputs);
  for (const auto& [name, pixels] : file.pictures) write_pfm(folder / name, pixels);
  for (const auto& [name, mesh] : file.meshes) write_text_or_rescue(folder / name, mesh);
  write_text_or_rescue(command.output, file.text);
  return 0;
}

}  // namespace tyndall
