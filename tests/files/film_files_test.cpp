#include "core/files/film_files.h"

#include "core/image/image_io.h"
#include "core/scene/load.h"
#include "tests/support/pictures.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

namespace tyndall::test::film_files_test {

namespace {

Film small_film() {
  Film film = make_film(2, 1, {0, 0, 2, 1}, 0, 4);
  for (FilmPixel& pixel : film.pixels) {
    add_sample(pixel, 0, {1, 1, 1}, 0.25);
    pixel.taken = 1;
  }
  return film;
}

}  // namespace

TEST_CASE("films with and without chains are told apart, where chains would be looked for") {
  const auto both = [](const char* name) {
    Scene by_specular_paths = small_scene(name, 2, 1, 1), scatter = by_specular_paths;
    scatter.render.caustics = Caustics::scatter;
    return same_samples(by_specular_paths, scatter);
  };
  CHECK_FALSE(both("stress-caustic-glass"));
  CHECK(both("cornell-box"));  // no spheres: the samples are the same
  Scene path = small_scene("stress-caustic-glass", 2, 1, 1), other = path;
  path.render.integrator = other.render.integrator = Integrator::path;
  other.render.caustics = Caustics::scatter;
  CHECK(same_samples(path, other));  // chains belong to mis
  other.render.spp = 9;
  CHECK(same_samples(path, other));  // each film says how many it has
  other.render.seed = 7;
  CHECK_FALSE(same_samples(path, other));
}

TEST_CASE("films that share and films that do not are told apart, where sharing pays") {
  const auto both = [](const char* name, int size) {
    Scene shared = close_up(name, size, size), alone = shared;
    alone.render.sharing = false;
    return same_samples(shared, alone);
  };
  CHECK_FALSE(both("cornell-box", 64));
  CHECK(both("cover", 64));
}

TEST_CASE("a film file says how caustics were found; files that do not are older than chains") {
  const auto folder = scratch_folder("caustics");
  const Film film = small_film();
  Scene scene = small_scene("stress-caustic-glass", 2, 1, 1);
  if (!has_openexr()) return;
  for (const Caustics caustics : {Caustics::chains, Caustics::scatter}) {
    scene.render.caustics = caustics;
    write_exr(folder / "new.exr", film, {}, {embedded_scene(scene, {}, film, folder / "new.exr"), ""});
    const Scene stored = read_stored_film(folder / "new.exr").scene;
    CHECK(stored.render.caustics == caustics);
    CHECK(stored.render.sharing);
    CHECK(same_samples(stored, scene));
  }
  scene.render.caustics = Caustics::chains;
  write_exr(folder / "old.exr", film, {}, {write_scene(scene), ""});
  const StoredFilm old = read_stored_film(folder / "old.exr");
  CHECK(old.part.film.pixels == film.pixels);
  CHECK(old.scene.render.caustics == Caustics::scatter);
  CHECK_FALSE(old.scene.render.sharing);
  CHECK_FALSE(same_samples(old.scene, scene));
}

TEST_CASE("films of one scene belong together if its pictures have the same pixels; what labels do not say fits") {
  const auto folder = scratch_folder("contents");
  const Scene scene = small_scene("earth", 2, 1, 1);
  const std::string hash = contents_hash(scene);
  CHECK(hash.size() == 16);
  CHECK(contents_hash(small_scene("cornell-box", 2, 1, 1)).empty());
  const FilmLabel label{"1.0", "avx2", false, hash}, nothing{};
  const auto found = [&](const FilmLabel& other) {
    const auto difference = differing_samples(scene, other, scene, label);
    return difference ? difference->found : "";
  };
  CHECK(found(label).empty());
  CHECK(found(nothing).empty());
  CHECK(found({"1.0", "avx2", false, std::string(16, '0')}) == "a film of other pixels in its textures or sky");
  CHECK(found({"1.1", "avx2", false, hash}) == "a film of version 1.1");
  CHECK(found({"1.0", "sse4", false, hash}) == "a film of instruction set sse4");
  const auto remark = [&](const FilmLabel& written) {
    write_png(folder / "a.png", {1, 1, {1, 1, 1}}, 0, ToneMap::srgb,
              {embedded_scene(scene, load_scene("earth").folder, small_film(), folder / "a.png"), "", written});
    return contents_remark(load_scene((folder / "a.png").string()));
  };
  CHECK(remark(label).empty());
  CHECK(remark(nothing).find("does not say which pixels") != std::string::npos);
  CHECK(remark({"", "", false, std::string(16, '0')}).find("have other pixels now") != std::string::npos);
}

TEST_CASE("a film that is added from others says of which instruction sets they are") {
  const FilmLabel avx2{"1.0", "avx2", false}, scalar{"1.0", "scalar", true}, old{};
  CHECK(merged_label(avx2, avx2).isa == "avx2");
  const FilmLabel both = merged_label(scalar, avx2);
  CHECK(both.isa == "several: avx2, scalar");
  CHECK(both.version == "1.0");
  CHECK(both.unfinished);
  CHECK(merged_label(avx2, both).isa == both.isa);
  CHECK(merged_label(both, merged_label({"1.0", "sse4", false}, scalar)).isa == "several: avx2, scalar, sse4");
  CHECK(merged_label(avx2, old).isa == "several: avx2, unknown");
  CHECK(merged_label(old, old).isa.empty());
}

}  // namespace tyndall::test::film_files_test
