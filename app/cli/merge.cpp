#include "app/cli/commands.h"
#include "app/files/film_files.h"
#include "app/files/outputs.h"
#include "app/text/standard_streams.h"

namespace tyndall {
namespace {

/// Reads a part. Its layers (albedo, normal, depth) are not read: a merged EXR has none.
bool write(const Film& film, const Scene& scene, const MergeCommand& command) {
  const auto embedded = [&](const std::filesystem::path& file) {
    return Embedded{embedded_scene(scene, ".", film, file), ""};
  };
  const LinearImage image{film.region.width(), film.region.height(), resolve(film)};
  const auto problems = write_images({film, image, scene.display, embedded, {}}, command.outputs);
  for (const std::string& problem : problems) complain(problem);
  return problems.empty();
}

}  // namespace

int run(const MergeCommand& command) {
  check_image_names(command.outputs);
  for (const auto& file : command.outputs) check_can_write(file);
  std::vector<FilmPart> parts;
  std::optional<Scene> scene;
  for (const auto& file : command.parts) {
    StoredFilm stored = read_stored_film(file);
    if (stored.scene.render.adaptive)
      throw UsageError(file.string() + ": found an adaptive render, expected a range of samples that every pixel has");
    if (scene && !same_samples(*scene, stored.scene))
      throw UsageError(file.string() + ": found a film of another scene or other settings than in " +
                       command.parts.front().string());
    if (!scene) scene = stored.scene;
    parts.push_back(std::move(stored.part));
  }
  const Film film = merge(std::move(parts));
  return write(film, *scene, command) ? 0 : output_failed;
}

}  // namespace tyndall
