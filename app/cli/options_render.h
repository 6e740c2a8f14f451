#pragma once
#include "app/cli/parse.h"
#include "app/cli/requests.h"

/// The options of the commands that render, and the groups of options that several commands share.
namespace tyndall {

/// Read the words after "view", "render", "verify", "chart" or "compare".
Command read_view(const std::vector<std::string>& arguments);
Command read_render(const std::vector<std::string>& arguments);
Command read_sweep(const std::vector<std::string>& arguments);
Command read_animate(const std::vector<std::string>& arguments);
Command read_verify(const std::vector<std::string>& arguments);
Command read_chart(const std::vector<std::string>& arguments);
Command read_compare(const std::vector<std::string>& arguments);

/// Groups of options that commands share.
void add_image_options(CLI::App& app, SceneRequest& scene);
/// --spp, --time and --target-error. of: whose they are, in the group's name.
void add_limits(CLI::App& app, RenderCommand& command, const std::string& of);
/// --region and --denoise.
void add_picture_options(CLI::App& app, RenderCommand& command);
/// --checkpoint and --fresh. fresh: help of the latter.
void add_keeping_options(CLI::App& app, RenderCommand& command, const std::string& fresh);
/// --gamma2 and --exr-film.
void add_forms(CLI::App& app, ImageForm& form);
/// Refuses options that exclude each other.
void refuse_conflicts(const RenderCommand& command);
void add_method_options(CLI::App& app, SceneRequest& scene);
void add_machine_options(CLI::App& app, int& threads, std::string& isa);
void add_isa(CLI::App& app, std::string& isa);
/// --gamma2. help: what the command does by it.
void add_gamma2(CLI::App& app, const std::string& help, PpmCurve& ppm);
/// -o FILE, repeatable, and the options that say how images are written. help: what the command says of -o.
void add_outputs(CLI::App& app, const std::string& help, std::vector<std::filesystem::path>& files, ImageForm& form);
/// --progress, and -q in place of "--progress none".
void add_progress(CLI::App& app, ProgressStyle& style);

/// Adds SCENE and --set. note: text that is added to the help of SCENE.
void add_scene(CLI::App& app, SceneRequest& scene, const std::string& note = "");
/// --set and -I alone.
void add_scene_options(CLI::App& app, SceneRequest& scene);

}  // namespace tyndall
