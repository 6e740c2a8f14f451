#include "core/files/film_files.h"

#include "core/scene/load.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <string>

namespace tyndall::test::stats_test {

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

}  // namespace tyndall::test::stats_test
