#include "core/render/pass.h"
#include "core/render/progression.h"
#include "tests/support/probe.h"
#include "tests/support/thorough.h"
#include "tests/support/watched_renderer.h"

#include <doctest/doctest.h>

#include <limits>

/// What a picture lacks: rejected samples are left out, counted and located, what cut paths carried is summed, and
/// paths that roulette ends at random lose nothing.
namespace tyndall::test::losses_test {

namespace {

/// A light of radius `light` in the middle of a matt sphere of radius 1, seen from between them towards the wall.
Scene integrating_sphere(double rho, double light) {
  Scene scene = dark_room();
  add(scene, sphere({0, 0, 0}, 1), lambertian(rho));
  add(scene, sphere({0, 0, 0}, light), lamp(1));
  aim(scene, {0, 0.2, 0.95 * light + 0.05}, {0, 0.5, 1});
  return scene;
}

/// A wall point sees the light under the share f of its cosine-weighted sky, and the wall itself under the rest.
double wall_radiance(double rho, double light) {
  const double f = light * light;
  return rho * f / (1 - rho * (1 - f));
}

}  // namespace

TEST_CASE("roulette: a path's brightest channel decides how likely it ends") {
  Scene scene = integrating_sphere(0.5, 0.5);
  scene.materials[0].colour = Vec3d{0.9, 0.2, 0.02};
  const Film film = film_of(scene, 4096);
  ZScores scores;
  scores.add("red", estimate(channel_of(film, &Vec3f::x)), wall_radiance(0.9, 0.5), 3e-3);
  scores.add("green", estimate(channel_of(film, &Vec3f::y)), wall_radiance(0.2, 0.5), 3e-3);
  scores.add("blue", estimate(channel_of(film, &Vec3f::z)), wall_radiance(0.02, 0.5), 3e-3);
}

TEST_CASE("depth: the rest is cut and counted: what light counts is a known answer of verify") {
  ZScores scores;
  for (const auto& [rho, depth] : {std::pair{0.5, 1}, {0.5, 2}, {0.95, 5}, {0.95, 10}}) {
    const double light = 0.4, f = light * light;
    REQUIRE(std::pow(rho, depth - 1) * 8 >= 1);  // until roulette starts a path is cut if it never met the light
    Scene scene = integrating_sphere(rho, light);
    scene.render.max_depth = depth;
    const Film film = film_of(scene, 1024);
    std::vector<double> cut;
    for (const FilmPixel& pixel : film.pixels) cut.push_back(pixel.truncated / 1024.0);
    scores.add("cut", estimate(cut), std::pow(1 - f, depth), 0.02);
  }
}

TEST_CASE("depth: glass, media and metal are events; a medium's boundary is none") {
  Scene scene = white_room();
  aim(scene, {0, 0, 5}, {0, 0, 0});
  const auto seen_with = [&](int depth) {
    scene.render.max_depth = depth;
    return totals(film_of(scene, 1));
  };
  add_medium(scene, sphere({0, 0, 0}, 1), {1e-20, 0}, 1);
  CHECK(seen_with(0).truncated == 0);
  add(scene, Quad<>{{-9, -9, 2}, {18, 0, 0}, {0, 18, 0}}, glass(1));
  CHECK(seen_with(0).truncated == 1024);
  CHECK(seen_with(1).truncated == 0);
  add(scene, sphere({0, 0, 0}, 0.5), glass(1));
  CHECK(seen_with(2).truncated == 1024);
  CHECK(seen_with(3).truncated == 0);
  add(scene, Quad<>{{-9, -9, -2}, {18, 0, 0}, {0, 18, 0}}, metal(1, 0));
  CHECK(seen_with(6).truncated == 1024);
  CHECK(seen_with(7).truncated == 0);
}

namespace {

/// Media in which one of two media has an albedo that is no number: some samples meet it.
RenderScene poisoned() {
  Scene scene = white_room();
  scene.width = 40, scene.height = 30;
  scene.camera = {.look_from = {0, 0, 4}, .look_at = {0, 0, 0}, .vfov = 45};
  add_medium(scene, sphere({-0.5, 0, 0}, 0.5), {0.5, 0}, 0.9);
  add_medium(scene, sphere({0.7, 0.2, 0}, 0.4), {0.02, 0}, 0.9);
  RenderScene compiled = compile(scene);
  compiled.media[1].albedo.y = std::numeric_limits<float>::quiet_NaN();
  return compiled;
}

RenderResult result_of(const RenderScene& scene, const char* isa, int threads, int tile, std::uint32_t first = 0,
                       std::uint32_t spp = 16) {
  return render(scene, {.threads = threads, .isa = isa, .first_sample = first, .spp = spp, .tile = tile});
}

/// The rejected samples of a film by trying all, one by one.
std::vector<RejectedSample> all_rejected(const RenderScene& scene, const Kernels& kernels, std::uint32_t spp) {
  const SceneViewOf view(scene);
  std::vector<RejectedSample> all;
  for (int y = 0; y < scene.height; ++y)
    for (int x = 0; x < scene.width; ++x)
      for (std::uint32_t i = 0; i < spp; ++i) {
        FilmPixel pixel{};
        TileCounts counts;
        kernels.render_tile(view.view(), {{x, y, x + 1, y + 1}, 1, 0, i, i + 1}, scene.film_quantum, &pixel, counts);
        if (pixel.rejected[0] + pixel.rejected[1] > 0) all.push_back({x, y, i});
      }
  return all;
}

/// A matt hollow sphere of albedo rho around the eye, without light.
Scene cave(double rho, int depth) {
  Scene scene = dark_room();
  add(scene, sphere({0, 0, 0}, 1), lambertian(rho));
  scene.render.max_depth = depth;
  return scene;
}

}  // namespace

TEST_CASE("rejected samples: counted, located, and out of sum and count, whoever meets them first") {
  const RenderScene scene = poisoned();
  for (const Kernels& kernels : available_kernels()) {
    const std::vector<RejectedSample> all = all_rejected(scene, kernels, 16);
    CAPTURE(kernels.isa);
    REQUIRE(all.size() > 4);
    CHECK(all.size() < 40 * 30);
    const std::vector<RejectedSample> first(all.begin(), all.begin() + 4);
    const RenderResult reference = result_of(scene, kernels.isa, 1, 0);
    CHECK(totals(reference.film).rejected == all.size());
    CHECK(reference.first_rejected == first);
    for (const auto& [threads, tile] : {std::pair{2, 5}, {7, 64}}) {
      const RenderResult other = result_of(scene, kernels.isa, threads, tile);
      CHECK(other.film == reference.film);
      CHECK(other.first_rejected == first);
    }
    const FilmPixel& hit = reference.film.at(first[0].x, first[0].y);
    CHECK(hit.taken == 16);
    CHECK(counted(reference.film, hit, 0) + counted(reference.film, hit, 1) == 16 - hit.rejected[0] - hit.rejected[1]);
    for (const FilmPixel& pixel : reference.film.pixels) REQUIRE(std::isfinite(mean(reference.film, pixel).y));
  }
}

TEST_CASE("rejected samples: shards find the ones of their own range") {
  const RenderScene scene = poisoned();
  const std::vector<RejectedSample> all = all_rejected(scene, scalar_kernels(), 16);
  const RenderResult late = result_of(scene, "scalar", 2, 0, 9, 7);
  std::vector<RejectedSample> expected;
  for (const RejectedSample& r : all)
    if (r.sample >= 9 && expected.size() < 4) expected.push_back(r);
  CHECK(late.first_rejected == expected);
  CHECK(result_of(compile(cave(0.5, 5)), "scalar", 2, 0).first_rejected.empty());
}

TEST_CASE("rejected samples: a pass counts those of both halves") {
  const Ready ready(poisoned());
  Film film = make_film(40, 30, {0, 0, 40, 30}, 0, ready.scene.film_quantum, false);
  Pass pass(film.region, 0, 16);
  REQUIRE(pass.run(ready.engine, film, false));
  std::uint64_t rejected[2] = {0, 0};
  for (const FilmPixel& pixel : film.pixels)
    for (int half = 0; half < 2; ++half) rejected[half] += pixel.rejected[half];
  CHECK(rejected[0] > 0);
  CHECK(rejected[1] > 0);
  CHECK(pass.rejected() == rejected[0] + rejected[1]);
}

TEST_CASE("cut paths: what they carried is summed, exactly, for any depth") {
  // Every event takes 1 - rho; roulette starts below an eighth.
  for (const double rho : {0.5, 0.75, 1.0})
    for (const int depth : {0, 1, 2, 5})
      for (const Kernels& kernels : available_kernels()) {
        if (std::pow(rho, depth) < 0.125) continue;
        const Film film = film_of(cave(rho, depth), 3, kernels.isa);
        CAPTURE(rho);
        CAPTURE(depth);
        CHECK(totals(film).truncated == totals(film).samples);
        CHECK(totals(film).cut_throughput == std::pow(rho, depth + 1));
      }
  CHECK(totals(film_of(cave(0.0, 0), 3)).cut_throughput == 0);
}

TEST_CASE("cut paths: with roulette the mean is what would be without") {
  std::vector<double> means;
  for (std::uint32_t seed = 0; seed < 16; ++seed) {
    Scene scene = cave(0.7, 19);
    scene.render.seed = seed;
    means.push_back(totals(film_of(scene, 64)).cut_throughput);
  }
  ZScores scores;
  scores.add("carried", estimate(means), std::pow(0.7, 20), 0.02);
}

TEST_CASE("cut paths: the brightest channel counts, and a channel without throughput loses nothing") {
  Scene scene = cave(0.5, 1);
  scene.materials[0].colour = Vec3d{0, 0.5, 0.25};
  CHECK(totals(film_of(scene, 2)).cut_throughput == 0.25);
}

TEST_CASE("cut paths: the same sum for any threads, tiles and shards, in interrupted films and restarts") {
  Scene room = small_scene("cornell-smoke", 61, 43, 24);
  room.render.max_depth = 4;
  const RenderScene scene = compile(room);
  for (const Kernels& kernels : available_kernels()) {
    const Film whole = result_of(scene, kernels.isa, 1, 0, 0, 24).film;
    CHECK(totals(whole).truncated > 1000);
    CHECK(totals(whole).cut_throughput > 0.01);
    CHECK(result_of(scene, kernels.isa, 7, 5, 0, 24).film == whole);
    CHECK(merged({{"b", result_of(scene, kernels.isa, 2, 9, 11, 13).film},
                  {"a", result_of(scene, kernels.isa, 3, 64, 0, 11).film}}) == whole);
    ThreadPool thread_pool(2);
    const SceneViewOf view(scene);
    Film film = make_film(61, 43, whole.region, 0, scene.film_quantum, !whole.emission.empty());
    const std::atomic<bool> no = false, yes = true;
    Pass pass(whole.region, 0, 24, 1, 0, {16});
    pass.run({thread_pool, kernels, view.view()}, film, yes);
    for (int time = 0; time < 2; ++time)
      CHECK(pass.run({thread_pool, kernels, view.view()}, film, no));  // then nothing is left
    CHECK(film == whole);
    Film uneven = make_film(61, 43, whole.region, 0, scene.film_quantum, !whole.emission.empty());
    Pass upper({0, 0, 61, 20}, 0, 24);
    CHECK(upper.run({thread_pool, kernels, view.view()}, uneven, no));
    Progression picture;
    picture.go_on(std::move(uneven), {});
    CHECK(
        picture.run_pass({thread_pool, kernels, view.view()}, {}, no));  // gives all pixels the same number of samples
    CHECK(picture.film() == whole);
  }
}

TEST_CASE("cut paths: an edit starts the sum anew; frames tell its share") {
  Scene room = small_scene("cornell-smoke", 61, 43, 8);
  room.render.max_depth = 4;
  WatchedRenderer renderer;
  renderer.submit(room);
  renderer.wait_for([](const Frame& frame) { return frame.spp >= 1; });
  room.camera.look_from.x += 1;
  const FramePointer last = renderer.wait_finished(renderer.submit(room));
  const Film film = result_of(compile(room), "", 1, 0, 0, 8).film;
  CHECK(renderer->film() == film);
  CHECK(last->cut_throughput == doctest::Approx(totals(film).cut_throughput));
}

TEST_CASE(
    "built-in scenes: of 1024 samples a pixel none is rejected, and what limits of 200 and more cut is not seen") {
  if (!thorough()) return;
  for (const BuiltIn& built_in : built_in_scenes()) {
    const Scene scene = small_scene(built_in.name, 48, 36, 1024);
    const RenderScene compiled = compile(scene);
    for (const Kernels& kernels : {available_kernels().back(), scalar_kernels()}) {
      const FilmTotals sum = totals(render(compiled, {.isa = kernels.isa, .spp = kernels.lanes == 1 ? 64 : 1024}).film);
      CAPTURE(built_in.name);
      CAPTURE(std::string(kernels.isa));
      CHECK(sum.rejected == 0);
      if (scene.render.max_depth >= 200) CHECK(sum.cut_throughput < 1e-3);
      if (scene.render.max_depth >= 1000) CHECK(sum.truncated == 0);
    }
  }
}

}  // namespace tyndall::test::losses_test
