#pragma once
#include "app/command_line.h"
#include "app/options.h"

namespace tyndall {

/// Words after "view", "render" and "verify" as commands.
Command read_view(const std::vector<std::string>& words);
Command read_render(const std::vector<std::string>& words);
Command read_verify(const std::vector<std::string>& words);

/// SCENE and --set. note: added to the help of SCENE.
void add_scene(CommandLine& line, SceneRequest& scene, const std::string& note = "");

}  // namespace tyndall
