#include "core/render/progression.h"
#include "core/render/views.h"
#include "tests/support/watched_renderer.h"

#include <doctest/doctest.h>

#include <cmath>
#include <thread>

/// A part of the picture that gets its samples before the rest, and what is told of one pixel.
namespace tyndall::test::refine_first_test {

namespace {

Ready small(const char* name) { return Ready(compile(small_scene(name, 61, 43, 1))); }

}  // namespace

TEST_CASE("a part that is refined first has prefixes of the same samples, and the picture is the same in the end") {
  // With light that groups of pixels share, and without.
  for (const char* name : {"cornell-box", "showroom"}) {
    const Ready ready = small(name);
    const RenderEngine& engine = ready.engine;
    const Film whole = render(ready.scene, {.spp = 40}).film;
    Progression picture;
    picture.start(ready.scene, {0, 0, 61, 43}, 0, {.coarse_step = 4, .first = {20, 10, 33, 21}});
    const Limits limits{.spp = 40};
    while (picture.max_taken() < 40) REQUIRE(picture.run_pass(engine, limits, false));
    CHECK(picture.taken() == 1);
    CHECK(picture.film().at(25, 15) == whole.at(25, 15));
    CHECK(picture.film().at(60, 42).taken == 1);
    CHECK_FALSE(picture.reached(limits));
    // Another part, given up on the way; then the whole picture.
    picture.set_first({0, 30, 10, 43});
    REQUIRE(picture.run_pass(engine, limits, false));
    CHECK(picture.film().at(5, 40).taken > 1);
    CHECK(picture.film().at(60, 42).taken == 1);
    picture.set_first({});
    REQUIRE(picture.run_pass(engine, limits, false));
    CHECK(picture.film().at(60, 42).taken == 2);
    CHECK(picture.taken() == 2);
    CHECK(picture.film().at(25, 15).taken == 40);
    // The film can be kept and gone on with.
    Progression again;
    again.go_on(picture.film(), {});
    CHECK(again.taken() == 2);
    while (!again.reached(limits)) REQUIRE(again.run_pass(engine, limits, false));
    CHECK(again.film() == whole);
    while (!picture.reached(limits)) REQUIRE(picture.run_pass(engine, limits, false));
    CHECK(picture.film() == whole);
  }
}

TEST_CASE("a part that is refined first: beyond the picture it is nothing, and adaptive sampling knows better") {
  const Ready ready = small("cornell-smoke");
  for (const bool adaptive : {false, true}) {
    const Region first = adaptive ? Region{0, 0, 9, 9} : Region{61, 0, 99, 9};
    Progression picture;
    picture.start(ready.scene, {0, 0, 61, 43}, 0, {.adaptive = adaptive, .first = first});
    for (int pass = 0; pass < 3; ++pass) REQUIRE(picture.run_pass(ready.engine, {.spp = 64}, false));
    CHECK(picture.taken() == 4);
    CHECK(picture.max_taken() == 4);
  }
}

TEST_CASE("the renderer refines a part first, and reports on a pixel after each pass and when asked at rest") {
  const Scene scene = small_scene("showroom", 160, 100, 64);
  WatchedRenderer renderer;
  renderer.set(&RenderRequest::refine_first, {40, 40, 60, 60});
  renderer.set(&RenderRequest::watched_pixel, std::pair{50, 50});
  const std::uint64_t edit = renderer.submit(scene);
  const FramePointer refined =
      renderer.wait_for([&](const Frame& f) { return f.edit == edit && f.max_spp == 64 && f.spp == 1; }, 0);
  CHECK_FALSE(refined->finished);
  const FramePointer last = renderer.wait_finished(edit);
  CHECK(last->spp == 64);
  CHECK(last->max_spp == 64);
  const auto report = renderer->reply().pixel;
  REQUIRE(report);
  CHECK(report->x == 50);
  CHECK(report->samples == 64);
  CHECK(report->edit == edit);
  const float* shown = last->rgba.data() + 4 * (50 * 160 + 50);
  CHECK(report->mean == Vec3f{shown[0], shown[1], shown[2]});
  renderer.set(&RenderRequest::watched_pixel, std::pair{7, 9});
  const auto other = [&] { return renderer->reply().pixel->x == 7; };
  while (!other()) std::this_thread::yield();
  CHECK(renderer->reply().pixel->samples == 64);
}

TEST_CASE("the standard error of a pixel is half of the difference of its halves, as the pixels around tell it") {
  // The pixels around have four times the samples, whose means differ half as much.
  Film film = make_film(9, 9, {0, 0, 9, 9}, 0, 4);
  for (FilmPixel& pixel : film.pixels) {
    const bool middle = &pixel == &film.at(4, 4);
    pixel.taken = middle ? 2 : 8;
    for (std::uint32_t i = 0; i < pixel.taken; ++i) {
      const float value = 2 + (i % 2 ? 1.0f : -1.0f) * (middle ? 1.0f : 0.5f);
      add_sample(pixel, i % 2, {value, value, value}, 1 / film.quantum);
    }
  }
  PixelReport report{.x = 4, .y = 4}, outside{.x = 9, .y = 0};
  look_at_pixel(film, report), look_at_pixel(film, outside);
  CHECK(report.samples == 2);
  CHECK(report.mean.y == 2);
  CHECK(report.standard_error.y == doctest::Approx(1));
  CHECK(outside.samples == 0);
}

}  // namespace tyndall::test::refine_first_test
