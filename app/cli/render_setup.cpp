#include "app/cli/render_setup.h"

#include "app/files/film_files.h"
#include "app/files/outputs.h"
#include "core/base/text.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

/// Samples a pixel at which to stop.
std::uint32_t last_sample_count(const RenderCommand& command, const LoadedScene& loaded) {
  if (command.samples) return command.samples->last - command.samples->first;
  if (command.spp) return *command.spp;
  if (std::isfinite(command.time_limit) || command.target_error > 0) return most_samples;
  return static_cast<std::uint32_t>(loaded.scene.render.spp.value_or(64));
}

void check_region(const Region& region, const Scene& scene) {
  if (region.x1 <= scene.width && region.y1 <= scene.height) return;
  const auto pair = [](int x, int y) { return std::to_string(x) + "," + std::to_string(y); };
  throw UsageError("--region: found X1,Y1 = " + pair(region.x1, region.y1) + ", expected at most " +
                   pair(scene.width, scene.height) + ", the image's size");
}

void refuse_adaptive(const char* option, const char* why) {
  throw UsageError(std::string(option) + " and adaptive sampling exclude each other: " + why +
                   " (it comes from --adaptive, or from /render/adaptive of the scene)");
}

}  // namespace

Kernels find_kernels(const std::string& isa) {
  if (const auto kernels = choose_kernels(isa)) return *kernels;
  std::vector<std::string_view> names;
  for (const Kernels& kernels : available_kernels()) names.emplace_back(kernels.isa);
  throw UsageError("--isa: found " + in_quotes(isa) + ", expected " + one_of(names) +
                   ", which this build has and this CPU can run");
}

RenderOptions render_options(const RenderCommand& command, const LoadedScene& loaded) {
  const bool adaptive = loaded.scene.render.adaptive;
  if (adaptive && command.samples) refuse_adaptive("--samples", "it says which samples every pixel takes");
  if (adaptive && command.resume)
    refuse_adaptive("--resume", "a film file does not say how many each pixel was to get");
  if (command.region) check_region(*command.region, loaded.scene);
  RenderOptions options;
  options.threads = command.threads;
  options.isa = command.isa;
  options.region = command.region.value_or(Region{0, 0, loaded.scene.width, loaded.scene.height});
  options.first_sample = command.samples ? command.samples->first : 0;
  options.spp = last_sample_count(command, loaded);
  options.time_limit = command.time_limit;
  options.target_error = command.target_error;
  options.adaptive = adaptive;
  options.clean = command.denoise;
  return options;
}

Film film_to_resume(const RenderCommand& command, const LoadedScene& loaded, const RenderOptions& options) {
  if (!command.resume) return {};
  const auto file = std::find_if(command.outputs.begin(), command.outputs.end(), is_exr);
  if (file == command.outputs.end()) throw UsageError("--resume needs an output that ends in .exr");
  std::error_code error;
  if (!std::filesystem::exists(*file, error)) return {};
  StoredFilm stored = read_stored_film(*file);
  const Film& film = stored.part.film;
  const std::string advice = "; without --resume it is replaced";
  const Scene scene = move_textures(loaded.scene, loaded.folder, ".");
  if (!same_samples(stored.scene, scene) || film.region != *options.region)
    throw UsageError(file->string() + ": found a film of another scene, other settings or another region" + advice);
  if (film.first_sample != options.first_sample)
    throw UsageError(file->string() + ": found samples from " + std::to_string(film.first_sample) + ", expected from " +
                     std::to_string(options.first_sample) + advice);
  return std::move(stored.part.film);
}

}  // namespace tyndall
