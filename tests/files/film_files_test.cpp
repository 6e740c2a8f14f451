#include "core/files/film_files.h"

#include "core/image/image_io.h"
#include "core/render/render.h"
#include "core/scene/load.h"
#include "tests/support/pictures.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <string>

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

TEST_CASE("layers: the variance of pixels is what the picture's estimated error is made of") {
  const auto scene = prepare(small_scene("cornell-box", 16, 16, 1));
  RenderOptions options;
  options.spp = 8;
  const RenderResult result = render(*scene, options);
  const std::vector<Layer> layers = layers_of(*scene, result.film, available_kernels().front());
  REQUIRE(layers.size() == 4);
  CHECK(layers[3].name == "Variance");
  REQUIRE(layers[3].values.size() == 3 * result.film.pixels.size());
  for (std::size_t i = 0; i < result.film.pixels.size(); ++i) {
    const FilmPixel& pixel = result.film.pixels[i];
    const Vec3f apart = half_mean(result.film, pixel, 0) - half_mean(result.film, pixel, 1);
    CHECK(layers[3].values[3 * i + 1] == doctest::Approx(apart.y * apart.y / 4).epsilon(1e-4).scale(0));
  }
}

TEST_CASE("layers: without a sample in each half the variance is not known") {
  const auto scene = prepare(small_scene("cornell-box", 4, 4, 1));
  RenderOptions options;
  options.spp = 1;
  const Layer variance = layers_of(*scene, render(*scene, options).film, available_kernels().front()).back();
  for (const float v : variance.values) CHECK(std::isinf(v));
}

TEST_CASE("layers: what sees nothing is infinitely far") {
  Scene scene;
  scene.width = scene.height = 2;
  const auto empty = prepare(scene);
  RenderOptions options;
  options.spp = 1;
  const Layer depth = layers_of(*empty, render(*empty, options).film, available_kernels().front())[2];
  CHECK(depth.name == "Depth");
  for (const float v : depth.values) CHECK(std::isinf(v));
}

namespace {

struct Run {
  Scene scene = load_scene("cornell-smoke").scene;
  std::shared_ptr<const PreparedScene> prepared = prepare(scene);
  RenderResult result;
  FinishedPicture picture;
  Run() {
    result.film = make_film(scene.width, scene.height, {10, 20, 14, 22}, 5, 8);
    for (FilmPixel& pixel : result.film.pixels) {
      pixel.taken = 1;
      add_sample(pixel, 1, {0.5f, 0.25f, 1}, 1 / 8.0);
    }
    result.rays = 3000;
    result.seconds = 0.5;
    result.threads = 2;
    result.kernels = scalar_kernels();
    picture = finished_picture(*prepared, result);
  }
  RunFigures figures() const { return {"cornell-smoke", *prepared, result, picture, 2, 0.25, 1}; }
};

}  // namespace

TEST_CASE("figures: the names and the order that scripts rely on") {
  const Run run;
  const auto json = nlohmann::ordered_json::parse(stats_text(run.figures()));
  std::string keys;
  for (const auto& [key, value] : json.items()) keys += key + " ";
  CHECK(keys ==
        "scene width height spp samples rays shadow_rays seconds_render seconds_total seconds_build mrays_per_s "
        "msamples_per_s threads isa lanes kernel_features integrator sampler fresnel relative_error_estimate "
        "rejected_samples truncated_paths peak_memory_bytes image_hash version truncated_throughput "
        "first_rejected adaptive least_spp most_spp rare_bright_paths caustics denoised "
        "denoised_relative_error_estimate seconds_denoise denoised_hash sharing threads_from guide_ms "
        "guide_lobes split_events ");
}

TEST_CASE("figures of a region: its size, its samples, rates of this run alone, and null for what is not known") {
  const Run run;
  const auto json = nlohmann::json::parse(stats_text(run.figures()));
  CHECK(json["width"] == 4);
  CHECK(json["height"] == 2);
  CHECK(json["spp"] == 1);
  CHECK(json["samples"] == 8);
  CHECK(json["mrays_per_s"] == doctest::Approx(0.006));
  CHECK(json["msamples_per_s"] == doctest::Approx(6 / 0.5 / 1e6).scale(0));  // two were there before
  CHECK(json["relative_error_estimate"].is_null());                          // one half is empty
  CHECK(json["peak_memory_bytes"] > 1000000);
  const std::string hash = json["image_hash"];
  CHECK(hash.size() == 16);
  CHECK(hash.find_first_not_of("0123456789abcdef") == std::string::npos);
}

TEST_CASE("figures stay JSON when a scene's name is no UTF-8, or no time has passed") {
  Run run;
  run.result.seconds = 0;
  RunFigures figures = run.figures();
  figures.scene = "caf\xe9.json";
  CHECK(nlohmann::json::parse(stats_text(figures))["mrays_per_s"] == 0);
}

TEST_CASE("what images carry is the same in every run") {
  Run slow;
  slow.result.seconds = 77;
  slow.result.threads = 9;
  CHECK(embedded_stats_text(slow.figures()) == embedded_stats_text(Run().figures()));
  const auto json = nlohmann::json::parse(embedded_stats_text(slow.figures()));
  CHECK(json["first_sample"] == 5);
  CHECK(json["region"] == nlohmann::json{10, 20, 14, 22});
}

}  // namespace tyndall::test::film_files_test
