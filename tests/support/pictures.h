#pragma once
#include "core/files/film_files.h"
#include "core/film/film.h"
#include "core/scene/load.h"
#include "tests/support/prepared.h"

#include <string>
#include <vector>

/// Built-in scenes, small, and the pictures that blocking renders make of them.
namespace tyndall::test {

/// A built-in scene, `width` by `height` pixels, spp samples.
inline Scene small_scene(const std::string& name, int width, int height, int spp) {
  Scene scene = load_scene(name).scene;
  scene.width = width;
  scene.height = height;
  scene.render.spp = spp;
  return scene;
}

/// One of the Cornell boxes through a long lens, with the upper part of its walls: pixels see places that are so close
/// together that even a small picture shares second vertices (trace/scene_view.h).
inline Scene close_up(const std::string& name, int width, int height) {
  Scene scene = small_scene(name, width, height, 1);
  scene.camera.look_at = {278, 450, 555};
  scene.camera.vfov = 8;
  return scene;
}

/// A corner of the room of a mirror sphere under a small light: it shares second vertices and is lit by specular paths.
inline Scene caustic_close_up(int width, int height) {
  Scene scene = small_scene("stress-caustic-mirror", width, height, 1);
  scene.camera.look_at = {2, 0, -4};
  scene.camera.vfov = 5;
  return scene;
}

/// Whether films of both scenes could be added.
inline bool same_samples(const Scene& a, const Scene& b) { return !differing_samples(a, {}, b, {}); }

/// The picture that every other way of rendering must reproduce: one thread, one go.
inline std::vector<float> reference_picture(const Scene& scene, const std::string& isa = "") {
  return resolve(
      render(compile(scene), {.threads = 1, .isa = isa, .spp = static_cast<std::uint32_t>(scene.render.spp.value())})
          .film);
}

inline std::uint64_t hash_of(const Film& film) {
  return image_hash(film.region.width(), film.region.height(), resolve(film));
}

/// Merging of films that are in memory.
inline Film merged(const std::vector<FilmPart>& parts) {
  std::vector<FilmPart> frames = parts;
  for (FilmPart& frame : frames) frame.film.pixels.clear(), frame.film.emission.clear();
  return merge(frames, [&](std::size_t index) { return parts[index].film; });
}

}  // namespace tyndall::test
