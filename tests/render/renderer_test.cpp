#include "core/render/renderer.h"

#include "tests/support/watched_renderer.h"

#include <doctest/doctest.h>

#include <random>

/// The finished picture is the one that a blocking render gives, whatever was done to the renderer before.
namespace tyndall::test::renderer_test {

namespace {

constexpr int width = 93, height = 71, spp = 40;

Scene scene_of(const char* name) { return small_scene(name, width, height, spp); }

}  // namespace

TEST_CASE("renderer: the last frame is the blocking render's picture, bit for bit, on every instruction set") {
  for (const Kernels& kernels : available_kernels())
    for (const char* name : {"showroom", "cornell-smoke", "bouncing-spheres"}) {
      CAPTURE(kernels.isa);
      Scene scene = scene_of(name);
      scene.render.spp = 9;
      WatchedRenderer renderer(2, kernels.isa);
      const FramePointer last = renderer.wait_finished(renderer.submit(scene));
      CHECK(last->spp == 9);
      CHECK(last->isa == kernels.isa);
      CHECK(last->lanes == kernels.lanes);
      CHECK(last->width == width);
      CHECK(last->height == height);
      CHECK(last->rejected == 0);
      CHECK(rgb_of(*last) == reference_picture(scene, kernels.isa));
      CHECK(renderer->film() == render(compile(scene), {.isa = kernels.isa, .region = {}, .spp = 9u}).film);
    }
}

TEST_CASE("renderer: pauses, views, threads and restarts on the way change no bit of the end") {
  const Scene scene = scene_of("showroom");
  const std::vector<float> expected = reference_picture(scene);
  std::mt19937 engine(1);
  for (int round = 0; round < 6; ++round) {
    WatchedRenderer renderer(1 + round % 3);
    const std::uint64_t edit = renderer.submit(scene);
    for (int i = 0; i < 12; ++i) {
      switch (engine() % 5) {
        case 0:
          renderer.pause(true);
          break;
        case 1:
          renderer.set_view(static_cast<View>(engine() % 6));
          break;
        case 2:
          renderer.set(&RenderRequest::threads, 1 + static_cast<int>(engine() % 7));
          break;
        case 3:
          renderer.restart();
          break;
        default:
          renderer.pause(false);
      }
      let_it_work(std::chrono::microseconds(engine() % 8000));
    }
    renderer.set_view(View::beauty);
    renderer.pause(false);
    const FramePointer last =
        renderer.wait_for([&](const Frame& f) { return f.finished && f.edit == edit && f.view == View::beauty; });
    CHECK(last->spp == spp);
    CHECK(rgb_of(*last) == expected);
  }
}

TEST_CASE("renderer: an edit and its undo lead back to the same picture") {
  const Scene scene = scene_of("showroom");
  const std::vector<float> expected = reference_picture(scene);
  WatchedRenderer renderer;
  renderer.submit(scene);
  std::mt19937 engine(2);
  for (int i = 0; i < 10; ++i) {
    Scene edited = scene;
    switch (i % 5) {
      case 0:
        edited.camera.look_from.x += 1;
        break;
      case 1:
        edited.materials[1].kind = Dielectric<>{1.2};
        break;
      case 2:
        edited.width = 50, edited.height = 80;
        break;
      case 3:
        edited.objects.erase(edited.objects.begin() + 3);
        break;
      default:
        edited.background = Vec3d{900, 900, 900};  // another unit of the film
    }
    renderer.submit(edited);
    let_it_work(std::chrono::microseconds(engine() % 20000));
  }
  const std::uint64_t edit = renderer.submit(scene);
  CHECK(rgb_of(*renderer.wait_finished(edit)) == expected);
  for (const FramePointer& frame : renderer.frames())
    CHECK(frame->rgba.size() == 4u * static_cast<std::size_t>(frame->grid.columns * frame->grid.rows));
}

TEST_CASE("renderer: the finished flag stands until the limit is raised; then it goes on from there") {
  Scene scene = scene_of("cornell-smoke");
  scene.render.spp = 4;
  WatchedRenderer renderer;
  const std::uint64_t edit = renderer.submit(scene);
  const FramePointer early = renderer.wait_finished(edit);
  CHECK(early->spp == 4);
  const std::size_t before = renderer.frames().size();
  scene.render.spp = 11;
  CHECK(renderer.submit(scene) == edit);
  const FramePointer late = renderer.wait_for([](const Frame& f) { return f.finished && f.spp == 11; }, before);
  CHECK(rgb_of(*late) == reference_picture(scene));
  for (const FramePointer& frame : renderer.frames()) CHECK((frame->pass <= early->pass || frame->spp >= 4));
}

TEST_CASE("renderer: a limit below what is there finishes the picture as it is") {
  Scene scene = scene_of("cornell-box");
  scene.render.spp = 100000;
  WatchedRenderer renderer;
  renderer.submit(scene);
  renderer.wait_for([](const Frame& f) { return f.spp >= 2; });
  renderer.pause(true);
  renderer.catch_up();
  const FramePointer paused = renderer->latest();
  CHECK_FALSE(paused->finished);
  const std::size_t before = renderer.frames().size();
  scene.render.spp = 1;
  renderer.submit(scene);
  const FramePointer finished = renderer.wait_for([](const Frame& f) { return f.finished; }, before);
  CHECK(finished->spp == paused->spp);
  CHECK(finished->rgba == paused->rgba);
}

TEST_CASE("renderer: single pixels, rows and columns") {
  for (const auto& [w, h] : {std::pair{1, 1}, {1, 40}, {40, 1}, {7, 9}}) {
    Scene scene = small_scene("showroom", w, h, 12);
    WatchedRenderer renderer;
    CHECK(rgb_of(*renderer.wait_finished(renderer.submit(scene))) == reference_picture(scene));
  }
}

TEST_CASE("renderer: frames tell of error, time and memory") {
  const Scene scene = scene_of("showroom");
  WatchedRenderer renderer;
  renderer.wait_finished(renderer.submit(scene));
  std::uint64_t pass = 0;
  double seconds = 0, first = -1;
  for (const FramePointer& frame : renderer.frames()) {
    CHECK(frame->pass == ++pass);
    CHECK(frame->seconds > seconds);
    seconds = frame->seconds;
    CHECK(frame->first_picture_ms > 0);
    if (first < 0) first = frame->first_picture_ms;
    CHECK(frame->first_picture_ms == first);
    CHECK((frame->spp >= 2) == std::isfinite(frame->relative_error));
    CHECK(frame->mrays_per_s > 0);
    CHECK(frame->film_bytes == bytes_per_pixel(true) * width * height);
    CHECK(frame->threads == 2);
  }
}

TEST_CASE("renderer: the first picture's time counts from a restart, not from the edit long ago") {
  WatchedRenderer renderer;
  Scene scene = scene_of("cornell-box");
  scene.render.spp = 1;
  const double start = wall_seconds();
  const std::uint64_t edit = renderer.submit(scene);
  double sum = renderer.wait_finished(edit)->first_picture_ms;
  for (int round = 0; round < 20; ++round) {
    const std::size_t before = renderer.frames().size();
    renderer.restart();
    sum += renderer.wait_finished(edit, before)->first_picture_ms;
  }
  CHECK(sum <= 1000 * (wall_seconds() - start));  // they ran one after the other, so not longer than the whole test
}

}  // namespace tyndall::test::renderer_test
