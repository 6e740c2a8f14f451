#include "core/render/pass.h"
#include "core/render/plan.h"
#include "tests/support/statistics.h"
#include "tests/support/thorough.h"
#include "tests/support/watched_renderer.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>

/// Adaptive sampling gives the same picture on every machine, is unbiased, and gives hard parts a smaller error.
namespace tyndall::test::adaptive_test {

namespace {

constexpr int width = 61, height = 43;  // neither is a multiple of a tile's edge

const RenderScene& scene_of(const std::string& name) {
  static std::map<std::string, RenderScene> all;
  if (!all.contains(name)) all[name] = compile(small_scene(name, width, height, 1));
  return all[name];
}

RenderOptions options_of(std::uint32_t spp) { return {.threads = 2, .spp = spp, .adaptive = true}; }

}  // namespace

TEST_CASE("adaptive: the same film for any number of threads and any tiles, on every instruction set") {
  for (const Kernels& kernels : available_kernels())
    for (const char* name : {"showroom", "wide-view"}) {
      CAPTURE(kernels.isa);
      RenderOptions options = options_of(40);  // in the middle of a round
      options.isa = kernels.isa;
      options.threads = 1;
      const RenderResult reference = render(scene_of(name), options);
      const FilmTotals sum = totals(reference.film);
      CHECK(sum.min_taken < 40);
      CHECK(sum.max_taken >= 64);
      CHECK(sum.samples <= 40 * width * height);
      CHECK(labelled_spp(reference.film) == 40);
      for (const auto& [threads, tile] : {std::pair{2, 0}, {7, 5}, {2, 8}, {3, 1000}}) {
        options.threads = threads;
        options.tile = tile;
        const RenderResult other = render(scene_of(name), options);
        REQUIRE(other.film == reference.film);
        REQUIRE(hash_of(other.film) == hash_of(reference.film));
        CHECK(other.rays == reference.rays);
      }
    }
}

TEST_CASE("adaptive: by long and short passes, continued, and given up at any point") {
  for (const char* name : {"showroom", "stress-touching"}) {
    const RenderScene& scene = scene_of(name);
    const Film whole = render(scene, options_of(80)).film;
    Film film{};
    for (const std::uint32_t spp : {1u, 2u, 9u, 16u, 17u, 32u, 50u, 64u, 80u})
      film = render(scene, options_of(spp), {}, std::move(film)).film;
    CHECK(film == whole);
    RenderOptions looking = options_of(80);
    looking.target_error = 1e-9;  // never reached, but it makes passes short
    CHECK(render(scene, looking).film == whole);
    int calls = 0, stops = 0;
    for (film = {}; !(film == whole) && stops < 1000;) {
      RenderResult part = render(
          scene, options_of(80), [&](const RenderProgress&) { return ++calls % 2 > 0; }, std::move(film));
      film = std::move(part.film);
      stops += part.interrupted ? 1 : 0;
    }
    CHECK(film == whole);
    CHECK(stops > 1);
  }
}

TEST_CASE("adaptive: a pass that is given up leaves prefixes, and goes on to the same film") {
  const RenderScene& scene = scene_of("showroom");
  const SceneViewOf view(scene);
  const Film whole = render(scene, options_of(128)).film;
  Film film = render(scene, options_of(64)).film;
  ThreadPool thread_pool(2);
  plan_round(film, thread_pool);
  stop.real = available_kernels().back();
  Kernels stopping = stop.real;
  for (RenderTile& quantum : stopping.render) quantum = stopping_tile;
  const std::vector<std::uint32_t> wanted = counts_at(film, 128);
  Pass pass(film, wanted, film.region);
  int abandoned = 0;
  for (bool done = false; !done; ++abandoned) {
    stop.tiles_left = 3;
    stop.give_up = false;
    done = pass.run({thread_pool, stopping, view.view()}, film, stop.give_up);
    for (std::size_t i = 0; i < wanted.size(); ++i) REQUIRE(film.pixels[i].taken <= wanted[i]);
  }
  CHECK(abandoned > 10);
  CHECK(film == whole);
}

TEST_CASE("adaptive: the window has the headless render's film") {
  Scene scene = small_scene("showroom", width, height, 70);
  scene.render.adaptive = true;
  WatchedRenderer renderer;
  const FramePointer frame = renderer.wait_finished(renderer.submit(scene));
  CHECK(frame->spp == 70);
  const Film film = render(compile(scene), options_of(70)).film;
  CHECK(rgb_of(*frame) == resolve(film));
  CHECK(renderer->film() == film);
  scene.render.adaptive = false;
  const std::size_t so_far = renderer.frames().size();
  const FramePointer even = renderer.wait_finished(renderer.submit(scene), so_far);
  CHECK(rgb_of(*even) == reference_picture(scene));
}

TEST_CASE("adaptive: a region has its own samples, no more than asked for") {
  RenderOptions options = options_of(64);
  options.region = Region{0, 3, 61, 40};
  const Film film = render(scene_of("stress-touching"), options).film;
  CHECK(film.region == *options.region);
  CHECK(totals(film).max_taken > totals(film).min_taken);
  CHECK(labelled_spp(film) == 64);
}

TEST_CASE("adaptive: the mean over a picture is that of even samples, to 0.1 %, or 0.01 % where tests are thorough") {
  // In the first scene, of glass, metal and a light in media, the errors that decide on the counts come from rare
  // bright paths.
  constexpr const char* names[] = {"showroom", "wide-view", "stress-medium-in-glass"};
  for (const char* name : tried(names, 1)) {
    Scene scene = thorough() ? small_scene(name, 48, 36, 64) : small_scene(name, 40, 30, 64);
    std::vector<double> ratios;
    for (std::uint32_t seed = 0; seed < (thorough() ? 600u : 48u); ++seed) {
      double mean[2] = {};
      for (const bool adaptive : {false, true}) {
        scene.render.seed = seed;
        RenderOptions options = options_of(64);
        options.adaptive = adaptive;
        for (const float value : resolve(render(compile(scene), options).film))
          mean[adaptive ? 1 : 0] += static_cast<double>(value);
      }
      ratios.push_back(mean[1] / mean[0] - 1);
    }
    const Estimate bias = estimate(ratios);
    CAPTURE(name);
    CAPTURE(bias.mean);
    CHECK(bias.error < (thorough() ? 4e-5 : 3e-4));  // or the measurement would be too rough to find a fault
    CHECK(std::abs(bias.mean) < (thorough() ? 1e-4 : 1e-3));
  }
}

}  // namespace tyndall::test::adaptive_test
