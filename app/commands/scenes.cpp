#include "app/commands/commands.h"
#include "app/standard_streams.h"
#include "core/scene/error.h"
#include "core/scene/load.h"

#include <algorithm>

namespace tyndall {

int run(const ScenesCommand&) {
  const std::vector<BuiltIn> scenes = built_in_scenes();
  if (scenes.empty()) throw IoError("no built-in scenes were found (TYNDALL_ASSETS names the folder that has scenes/)");
  std::size_t width = 0;
  for (const BuiltIn& scene : scenes) width = std::max(width, scene.name.size());
  std::string text;
  for (const BuiltIn& scene : scenes)
    text += scene.name + std::string(width + 2 - scene.name.size(), ' ') + scene.title + "\n";
  write_standard_output(text);
  return 0;
}

}  // namespace tyndall
