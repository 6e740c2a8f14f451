#pragma once
#include "app/cli/command_line.h"
#include "app/cli/requests.h"

namespace tyndall {

/// Words after "view", "render", "verify" and "chart" as commands.
Command read_view(const std::vector<std::string>& words);
Command read_render(const std::vector<std::string>& words);
Command read_verify(const std::vector<std::string>& words);
Command read_chart(const std::vector<std::string>& words);

/// Groups of options that commands share.
void add_method_options(CommandLine& line, SceneRequest& scene);
void add_machine_options(CommandLine& line, int& threads, std::string& isa);
void add_isa(CommandLine& line, std::string& isa);
void add_progress(CommandLine& line, ProgressStyle& style);

/// SCENE and --set. note: added to the help of SCENE.
void add_scene(CommandLine& line, SceneRequest& scene, const std::string& note = "");

}  // namespace tyndall
