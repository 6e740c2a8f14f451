#include "tests/support/same_picture.h"
#include "core/render/pass.h"
#include "tests/support/thorough.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>

/// The picture depends on scene, seed and samples alone: not on threads, tiles, passes, shards or interruptions.
namespace tyndall::test::same_picture_test {

namespace {

using namespace same_picture;

/// Samples first … last - 1 of the whole picture.
Film shard(const RenderScene& scene, const Kernels& kernels, std::uint32_t first, std::uint32_t last, int tile = 0) {
  RenderOptions options = options_of(kernels, last - first);
  options.first_sample = first;
  options.tile = tile;
  return render(scene, options).film;
}

}  // namespace

TEST_CASE("same picture: for any number of threads and any tiles, on every instruction set") {
  if (thorough()) check_threads_and_tiles({{7, 1}, {2, 0}, {2, 8}, {2, 64}, {2, 1000}, {7, 5}, {7, 8}, {7, 1000}});
  check_threads_and_tiles({{7, 5}, {2, 64}});
}

TEST_CASE("same picture: shards added in any order, whatever their sizes and tiles") {
  std::mt19937 engine(1);
  for (const Kernels& kernels : thorough() ? available_kernels() : std::vector{available_kernels().back()})
    for (const RenderScene& scene : scenes()) {
      CAPTURE(kernels.isa);
      const Film whole = shard(scene, kernels, 0, 13);
      for (int round = 0; round < (thorough() ? 3 : 1); ++round) {
        std::vector<FilmPart> parts;
        for (std::uint32_t first = 0; first < 13;) {
          const std::uint32_t last = std::min(13u, first + 1 + static_cast<std::uint32_t>(engine() % 6));
          parts.push_back({"part", shard(scene, kernels, first, last, static_cast<int>(engine() % 40))});
          first = last;
        }
        std::shuffle(parts.begin(), parts.end(), engine);
        REQUIRE(merged(parts) == whole);
      }
    }
}

TEST_CASE("same picture: the parts of random scenes of glass, mirrors and slabs are those of the whole") {
  check_cuts(1, thorough() ? 300 : 4);
}

TEST_CASE("same picture: by long and short passes, and continued from a film") {
  const std::uint32_t most = thorough() ? 40 : 20;
  for (const RenderScene& scene : scenes()) {
    const Kernels best = available_kernels().back();
    const Film whole = shard(scene, best, 0, most);
    Film film = shard(scene, best, 0, 1);
    for (const std::uint32_t spp : {2u, 5u, most - 7, most}) film = render(scene, options_of(best, spp), {}, film).film;
    CHECK(film == whole);
    RenderOptions timed = options_of(best, most);
    timed.target_error = 1e-9;  // never reached, but it makes passes short
    CHECK(render(scene, timed).film == whole);
  }
}

TEST_CASE("same picture: a region is cut from the whole") {
  for (const RenderScene& scene : scenes()) {
    RenderOptions options = options_of(available_kernels().back(), 3);
    const Film whole = render(scene, options).film;
    for (const Region& region :
         {Region{0, 0, 1, 1}, Region{7, 11, 40, 30}, Region{60, 42, 61, 43}, Region{13, 0, 14, 43}}) {
      options.region = region;
      const Film part = render(scene, options).film;
      CHECK(part.region == region);
      for (int y = region.y0; y < region.y1; ++y)
        for (int x = region.x0; x < region.x1; ++x) REQUIRE(part.at(x, y) == whole.at(x, y));
    }
  }
}

TEST_CASE("same picture: passes given up any number of times; every pixel's samples stay a prefix") {
  ThreadPool thread_pool(2);
  const Kernels real = available_kernels().back();
  Kernels stopping = real;
  std::fill(std::begin(stopping.render), std::end(stopping.render), stopping_tile);
  int abandoned = 0;
  for (const RenderScene& scene : scenes()) {
    const SceneViewOf view(scene);
    const Film whole = shard(scene, real, 0, 24);
    stop.real = real;
    Film film = make_film(width, height, whole.region, 0, scene.film_quantum, !whole.emission.empty());
    for (const auto& [first, last] : {std::pair{0u, 1u}, {1u, 3u}, {3u, 24u}}) {
      Pass pass(whole.region, first, last, 1, 0, {8});
      for (bool done = false; !done;) {
        stop.tiles_left = 3;
        stop.give_up = false;
        done = pass.run({thread_pool, stopping, view.view()}, film, stop.give_up);
        abandoned += done ? 0 : 1;
        for (const FilmPixel& pixel : film.pixels) REQUIRE((pixel.taken == first || pixel.taken == last));
      }
    }
    CHECK(film == whole);
  }
  CHECK(abandoned > 100);
}

TEST_CASE("same picture: coarse passes and the rest of the first sample are the first sample") {
  ThreadPool thread_pool(2);
  const Kernels kernels = available_kernels().back();
  for (const RenderScene& scene : scenes()) {
    const SceneViewOf view(scene);
    if (view.view().reuses_paths) continue;  // a coarse pass takes samples without their groups, which are replaced
    const Film whole = shard(scene, kernels, 0, 1);
    for (const int step : {8, 4, 2}) {
      Film film = make_film(width, height, whole.region, 0, scene.film_quantum, !whole.emission.empty());
      const std::atomic<bool> give_up = false;
      Pass coarse(whole.region, 0, 1, step), rest(whole.region, 0, 1, 1, step);
      CHECK(coarse.run({thread_pool, kernels, view.view()}, film, give_up));
      CHECK(coarse.paths() == static_cast<std::uint64_t>(((width + step - 1) / step) * ((height + step - 1) / step)));
      CHECK(rest.run({thread_pool, kernels, view.view()}, film, give_up));
      CHECK(coarse.paths() + rest.paths() == width * height);
      CHECK(film == whole);
    }
  }
}

TEST_CASE("breaks: films and results that are taken in between change no bit, also with adaptive sampling") {
  const RenderScene scene = compile(small_scene("showroom", 100, 60, 1));
  for (const bool adaptive : {false, true}) {
    CAPTURE(adaptive);
    RenderOptions options{.threads = 2, .spp = 200, .adaptive = adaptive};
    const RenderResult plain = render(scene, options);
    int films = 0, results = 0;
    std::uint64_t last = 0;
    options.breaks.film_due = options.breaks.result_due = [] { return true; };
    options.breaks.take_film = [&](const Film& film, ThreadPool&) {
      const FilmTotals sum = totals(film);
      CHECK(sum.samples >= last);
      last = sum.samples;
      ++films;
    };
    options.breaks.take_result = [&](const RenderResult& result) {
      CHECK(totals(result.film).samples == last);
      CHECK_FALSE(result.interrupted);
      ++results;
    };
    const RenderResult error = render(scene, options);
    CHECK(films > 3);
    CHECK(results == films);
    CHECK(error.film == plain.film);
    CHECK(error.rays == plain.rays);
  }
}

TEST_CASE("breaks: a time limit still ends a render between passes, so that all pixels have as many samples") {
  const RenderScene scene = compile(small_scene("showroom", 100, 60, 1));
  RenderOptions options{.threads = 2, .time_limit = 0.3};
  options.breaks.film_due = [] { return true; };
  options.breaks.take_film = [](const Film&, ThreadPool&) {};
  const FilmTotals sum = totals(render(scene, options).film);
  CHECK(sum.min_taken > 0);
  CHECK(sum.min_taken == sum.max_taken);
}

TEST_CASE("render: stops where it is told to and says so") {
  const RenderScene& scene = scenes()[0];
  RenderOptions options = options_of(available_kernels().back(), 1000000);
  int calls = 0;
  const RenderResult stopped = render(scene, options, [&](const RenderProgress& p) {
    CHECK(p.seconds >= 0);
    return ++calls < 3;
  });
  CHECK(stopped.interrupted);
  CHECK(totals(stopped.film).max_taken < 1000000);
  options.spp.reset();
  options.time_limit = 0.05;
  const RenderResult timed = render(scene, options);
  CHECK_FALSE(timed.interrupted);
  CHECK(timed.seconds >= 0.05);
  CHECK(totals(timed.film).min_taken == totals(timed.film).max_taken);
  CHECK(timed.rays > totals(timed.film).samples);
  options.isa = "no such set";
  CHECK_THROWS_AS(render(scene, options), std::invalid_argument);
}

}  // namespace tyndall::test::same_picture_test
