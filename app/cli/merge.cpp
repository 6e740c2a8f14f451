#include "app/cli/commands.h"
#include "app/cli/render_setup.h"
#include "app/files/film_files.h"
#include "app/files/outputs.h"
#include "app/files/stats.h"
#include "app/text/standard_streams.h"
#include "core/accuracy/rare.h"
#include "core/render/clean_film.h"

#include <fmt/core.h>

namespace tyndall {
namespace {

/// Writes the films' files and returns the exit code.
int write(const Film& film, const Scene& scene, const FilmLabel& label, const std::vector<std::filesystem::path>& files,
          const ImageForm& form, const std::optional<CleanOfFilm>& clean) {
  const std::vector<std::string> problems = write_film(film, scene, label, files, form, clean);
  for (const std::string& problem : problems) complain(problem);
  return problems.empty() ? 0 : output_failed;
}

}  // namespace

int run(const MergeCommand& command) {
  check_image_names(command.outputs, command.form);
  check_outputs(outputs_of("--output", command.outputs), command.parts);
  for (const auto& file : command.outputs) check_can_write(file);
  std::vector<FilmPart> frames;
  std::optional<Scene> scene;
  FilmLabel label;
  for (const auto& file : command.parts) {
    StoredFilm stored = read_stored_frame(file);
    if (stored.scene.render.adaptive)
      throw UsageError(file.string() + ": found an adaptive render, expected a range of samples that every pixel has");
    if (scene && !same_samples(*scene, stored.scene))
      throw UsageError(file.string() + ": found a film of another scene or other settings than in " +
                       command.parts.front().string());
    const std::string &version = stored.label.version, &before = label.version;
    if (scene && !version.empty() && !before.empty() && version != before)
      throw UsageError(fmt::format("{}: found a film of version {}, expected {} as in {}", file.string(), version,
                                   before, command.parts.front().string()));
    label = scene ? merged_label(label, stored.label) : stored.label;
    if (!scene) scene = stored.scene;
    frames.push_back(std::move(stored.part));
  }
  const Film film = merge(frames, [&](std::size_t part) { return read_film_alone(command.parts[part]); });
  std::optional<CleanOfFilm> clean;
  if (command.denoise) clean = clean_view(film, *scene, command.parts.front().string());
  return write(film, *scene, label, command.outputs, command.form, clean);
}

int run(const DenoiseCommand& command) {
  check_image_names(command.outputs, command.form, command.stats);
  find_kernels(command.isa);
  std::vector<Output> outputs = outputs_of("--output", command.outputs);
  outputs.push_back({"--stats", command.stats});
  check_outputs(outputs, {command.film});
  for (const auto& file : command.outputs) check_can_write(file);
  if (!command.stats.empty() && command.stats != "-") check_can_write(command.stats);
  const StoredFilm stored = read_stored_film(command.film);
  const Film& film = stored.part.film;
  const CleanOfFilm clean = clean_view(film, stored.scene, command.film.string(), command.threads, command.isa);
  const int code = write(film, stored.scene, stored.label, command.outputs, command.form, clean);
  if (is_doubtful(clean.picture, totals(film).least_taken))
    complain(std::string(rare_bright_paths) + "; the error may be larger than estimated");
  const std::string stats = clean_stats_text(film, clean.picture, clean.seconds);
  if (command.stats == "-")
    write_standard_output(stats);
  else if (!command.stats.empty())
    write_text_file(command.stats, stats);
  return code;
}

}  // namespace tyndall
