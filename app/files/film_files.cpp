#include "app/files/film_files.h"

#include "app/text/values.h"
#include "core/render/plan.h"
#include "core/scene/load.h"

#include <algorithm>
#include <variant>

namespace tyndall {
namespace {

/// The scene with everything at its default that changes no sample: names, display, number of samples.
void strip(Scene& scene) {
  scene.name.clear();
  scene.display = {};
  scene.render.spp.reset();
  for (Texture& texture : scene.textures)
    if (Image* image = std::get_if<Image>(&texture.kind)) image->file.clear();  // its pixels are compared
}

}  // namespace

StoredFilm read_stored_film(const std::filesystem::path& file) {
  std::optional<Film> film = read_film(file);
  if (!film) throw UsageError(file.string() + ": found no film, expected an EXR that 'tyndall render' wrote");
  LoadedScene loaded = load_scene(file.string());
  const Scene scene = move_textures(loaded.scene, loaded.folder, ".");
  return {{file.string(), std::move(*film)}, scene};
}

bool same_samples(Scene a, Scene b) {
  strip(a);
  strip(b);
  return a == b;
}

std::string embedded_scene(Scene scene, const std::filesystem::path& textures, const Film& film,
                           const std::filesystem::path& image) {
  scene.render.spp = static_cast<int>(std::clamp(labelled_spp(film), 1u, most_samples));
  return write_scene(move_textures(std::move(scene), textures, image.parent_path()));
}

}  // namespace tyndall
