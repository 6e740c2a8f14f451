#include "tests/support/watched_renderer.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>

/// Views, picking, films, and doing nothing when there is nothing to do.
namespace tyndall::test::renderer_views_test {

namespace {

/// A red wall 4 away, on its left half a group with a green sphere before it; beyond the wall's right edge blue sky.
Scene wall_and_sphere() {
  Scene scene;
  scene.width = 90, scene.height = 60;
  scene.background = Vec3d{0.1, 0.2, 0.9};
  scene.camera = {.look_from = {0, 0, 0}, .look_at = {0, 0, -1}, .vfov = 60};
  scene.render.spp = 8;
  scene.materials = {{"red", Vec3d{0.8, 0.1, 0.1}, Lambertian<>{}}, {"green", Vec3d{0.1, 0.7, 0.1}, Lambertian<>{}}};
  const Object ball{"ball", Solid3d{Sphere<>{{0, 0, 0}, 0.5, {}}, 1}, {}};
  const Object group{"group", Group{{ball}}, {Translate{{-1, 0, -3}}}};
  const Object fog{"fog", Volume{Sphere<>{{0, 0, 0}, 9, {}}, {}, Medium<>{0.01, 0}, Vec3d{1, 1, 1}}, {}};
  const Object wall{"wall", Solid3d{Quad<>{{-9, -9, -4}, {10.5, 0, 0}, {0, 18, 0}}, 0}, {}};
  scene.objects = {fog, group, wall};
  return scene;
}

Vec3f pixel(const Frame& frame, int x, int y) {
  const float* p = frame.rgba.data() + 4 * (y * frame.width + x);
  return {p[0], p[1], p[2]};
}

}  // namespace

TEST_CASE("views: albedo, normal, depth, samples and noise of what is there; they restart nothing") {
  WatchedRenderer renderer;
  const std::uint64_t edit = renderer.submit(wall_and_sphere());
  const FramePointer beauty = renderer.wait_finished(edit);
  const auto shown = [&](View view) {
    const std::size_t before = renderer.frames().size();
    renderer.set_view(view);
    return renderer.wait_for([&](const Frame& f) { return f.view == view; }, before);
  };
  const FramePointer albedo = shown(View::albedo), normal = shown(View::normal), depth = shown(View::depth);
  CHECK(pixel(*albedo, 27, 30) == Vec3f{0.1f, 0.7f, 0.1f});  // the sphere
  CHECK(pixel(*albedo, 50, 10) == Vec3f{0.8f, 0.1f, 0.1f});  // the wall
  CHECK(pixel(*albedo, 88, 30) == Vec3f{});                  // the sky
  CHECK(pixel(*normal, 50, 10) == Vec3f{0.5f, 0.5f, 1});
  CHECK(pixel(*depth, 50, 10).x == doctest::Approx(1));
  CHECK(pixel(*depth, 27, 30).x == doctest::Approx(2.5 / 4).epsilon(0.02).scale(0));
  CHECK(pixel(*shown(View::samples), 3, 3) == Vec3f{0.5f, 0.5f, 0.5f});  // all have as many
  const FramePointer cost = shown(View::cost);
  float maximum = 0;
  for (int y = 0; y < cost->height; ++y)
    for (int x = 0; x < cost->width; ++x) maximum = std::max(maximum, pixel(*cost, x, y).x);
  CHECK(maximum == 1);
  CHECK(pixel(*cost, 88, 30).x > 0);
  CHECK(pixel(*cost, 88, 30).x < 0.7f * pixel(*cost, 50, 10).x);  // the sky and the wall
  CHECK(depth->white == doctest::Approx(4));                      // the wall is the farthest
  CHECK(shown(View::samples)->white == 16);                       // twice the mean
  CHECK(cost->white > 1);
  const FramePointer object = shown(View::object);
  CHECK(pixel(*object, 88, 30) == Vec3f{});
  CHECK_FALSE(pixel(*object, 27, 30) == pixel(*object, 50, 10));
  CHECK(pixel(*object, 50, 10) == pixel(*object, 60, 50));
  const FramePointer noise = shown(View::noise);
  CHECK(noise->beauty == beauty->rgba);
  CHECK(beauty->beauty.empty());
  CHECK(pixel(*noise, 27, 30).x > 0.01f);
  CHECK(pixel(*noise, 27, 30).x < 1.0f);
  const FramePointer back = shown(View::beauty);
  CHECK(back->rgba == beauty->rgba);
  for (const FramePointer& frame : {albedo, normal, depth, cost, noise, back}) {
    CHECK(frame->spp == 8);
    CHECK(frame->finished);
    CHECK(frame->edit == edit);
  }
}

TEST_CASE("views: the costs of the last scene stay until those of the new one are found") {
  Scene scene = wall_and_sphere();
  scene.width = 900, scene.height = 600;
  WatchedRenderer renderer;
  renderer.set_view(View::cost);
  std::uint64_t edit = renderer.submit(scene);
  const auto is_there = [](const Frame& f) {
    return std::any_of(f.rgba.begin(), f.rgba.end(), [i = 0](float v) mutable { return i++ % 4 == 0 && v == 1; });
  };
  renderer.wait_for([&](const Frame& f) { return f.view == View::cost && is_there(f); });
  const std::size_t before = renderer.frames().size();
  for (int i = 0; i < 30; ++i) {
    scene.camera.look_at.x += 0.01;
    edit = renderer.submit(scene);
    let_it_work(std::chrono::milliseconds(5));
  }
  renderer.wait_for([&](const Frame& f) { return f.edit == edit && f.finished; }, before);
  const auto frames = renderer.frames();
  for (std::size_t i = before; i < frames.size(); ++i) CHECK(is_there(*frames[i]));
}

TEST_CASE("pick: the object's path, how deep it is, and where") {
  WatchedRenderer watched(1);
  const Renderer& renderer = *watched;
  Scene scene = wall_and_sphere();
  scene.objects[1].transform = {Translate{{-1 + 1e5, 0, -3}}};  // far from the origin the point keeps its digits
  scene.objects[2].transform = {Translate{{1e5, 0, 0}}};
  scene.camera.look_from.x = scene.camera.look_at.x = 1e5;
  watched.submit(scene);
  watched.wait_for([](const Frame&) { return true; });
  const Renderer::Pick ball = renderer.pick(27, 30), wall = renderer.pick(50, 10), sky = renderer.pick(88, 30);
  CHECK(ball.object == std::vector<int>{1, 0});
  CHECK(ball.depth == doctest::Approx(2.5).epsilon(0.01).scale(0));
  CHECK(length(ball.point - Vec3d{1e5 - 1, 0, -3}) == doctest::Approx(0.5).epsilon(1e-4).scale(0));
  CHECK(wall.object == std::vector<int>{2});
  CHECK(wall.depth == doctest::Approx(4));
  CHECK(wall.point.z == doctest::Approx(-4));
  const double height = std::tan(pi / 6) * 4;  // of half the picture, on the wall
  CHECK(wall.point.x - 1e5 == doctest::Approx(height * (50.5 - 45) / 30));
  CHECK(wall.point.y == doctest::Approx(height * (30 - 10.5) / 30));
  CHECK(sky.object.empty());
  for (const auto& [x, y] : {std::pair{-1, 0}, {0, -1}, {90, 0}, {0, 60}}) CHECK(renderer.pick(x, y).object.empty());
}

TEST_CASE("film: a copy of what was gathered, the same number of samples everywhere") {
  Scene scene = small_scene("showroom", 120, 90, 1000000);
  WatchedRenderer watched;
  const Renderer& renderer = *watched;
  watched.submit(scene);
  watched.wait_for([](const Frame& f) { return f.spp >= 1; });
  for (int i = 0; i < 5; ++i) {
    const Film film = renderer.film();
    const FilmTotals t = totals(film);
    CHECK(t.min_taken == t.max_taken);
    REQUIRE(t.min_taken > 0);
    CHECK(film == render(compile(scene), {.spp = t.min_taken}).film);
    if (i == 3) watched.pause(true);
  }
}

TEST_CASE("idle: a renderer that is finished, paused or unused takes no processor time") {
  const Scene scene = small_scene("showroom", 200, 150, 2);
  WatchedRenderer unused, finished, paused;
  finished.wait_finished(finished.submit(scene));
  Scene endless = scene;
  endless.render.spp = 1000000;
  paused.submit(endless);
  paused.wait_for([](const Frame& f) { return f.spp >= 2; });
  paused.pause(true);
  for (WatchedRenderer* renderer : {&unused, &finished, &paused}) renderer->catch_up();
  const std::size_t calls = unused.calls() + finished.calls() + paused.calls();
  const double before = cpu_seconds();
  std::this_thread::sleep_for(std::chrono::milliseconds(300));  // the time over which processor time is measured
  CHECK(cpu_seconds() - before < 0.03);
  CHECK(unused.calls() + finished.calls() + paused.calls() == calls);
}

}  // namespace tyndall::test::renderer_views_test
