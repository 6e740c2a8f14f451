#include "tests/support/pictures.h"
#include "tests/support/probe.h"

#include <doctest/doctest.h>

/// Scenes that say the same in another form have the same picture, bit for bit.
namespace tyndall::test::equal_scenes_test {

namespace {

/// A matt ground under the books' sky, and what is added to it.
Scene ground_with(auto add_things) {
  Scene scene = white_room();
  scene.width = 60, scene.height = 40;
  scene.background = Gradient{};
  scene.camera = {.look_from = {0.5, 0.7, 4}, .look_at = {0, 0, 0}, .vfov = 35};
  add(scene, sphere({0, -101, 0}, 100), lambertian(0.5));
  add_things(scene);
  return scene;
}

/// A ball that moves up by 2 while time goes from 0 to 1, or one that rests at `y`.
Scene ball_at(std::optional<Vec3d> end, double y, double open, double close) {
  return ground_with([&](Scene& s) {
    for (const double x : {-2.0, 2.0}) add(s, sphere({x, 0, 0}, 0.5), lambertian(0.5));
    add(s, Sphere<>{{0, y, 0}, 0.5, end}, lambertian(0.7));
    s.camera.shutter_open = open, s.camera.shutter_close = close;
  });
}

Scene hollow_ball(double inner, double index) {
  return ground_with([&](Scene& s) {
    add(s, sphere({0, 0, 0}, 1), glass(1.5));
    add(s, sphere({0, 0, 0}, inner), glass(index));
  });
}

Scene ball_in_fog(std::optional<double> density) {
  return ground_with([&](Scene& s) {
    add(s, sphere({0, 0, 0}, 1), lambertian(0.5));
    if (density) add_medium(s, sphere({0, 0, 0}, 2), {*density, 0}, 0.5);
  });
}

/// Nothing but sky: every ray goes straight on, in every bit.
Scene sky_through_glass(bool is_there) {
  Scene scene = white_room();
  scene.background = Gradient{{0.1, 0.2, 0.3}, {1, 0.5, 0.2}};
  scene.camera = {.look_from = {0, 0.2, 3}, .look_at = {0, 0, 0}};
  if (!is_there) return scene;
  add(scene, sphere({0, 0, 0}, 1), glass(1));
  add(scene, Box<>{{-2, -2, -2}, {2, 2, 1.5}}, glass(1), {RotateY{20}});
  return scene;
}

Scene focused(double defocus_angle, std::optional<double> distance) {
  return ground_with([&](Scene& s) {
    add(s, sphere({0, 0, 0}, 1), lambertian(0.5));
    s.camera.defocus_angle = defocus_angle, s.camera.focus_distance = distance;
  });
}

}  // namespace

TEST_CASE("equal scenes: the same picture, bit for bit, on every instruction set") {
  const double looked_at = length(Vec3d{0.5, 0.7, 4});
  const struct {
    std::string name;
    Scene one, other;
  } pairs[] = {
      {"hollow glass by negative radius and by relative index", hollow_ball(-0.9, 1.5), hollow_ball(0.9, 1 / 1.5)},
      {"fog of density 0", ball_in_fog(0), ball_in_fog({})},
      {"fog of density 1e-38", ball_in_fog(1e-38), ball_in_fog({})},
      {"fog of density 1e-30", ball_in_fog(1e-30), ball_in_fog({})},
      {"glass of index 1", sky_through_glass(true), sky_through_glass(false)},
      {"a moving ball whose two centres are equal", ball_at(Vec3d{0, 0, 0}, 0, 0, 1), ball_at({}, 0, 0, 1)},
      {"a moving ball at an instant", ball_at(Vec3d{0, 2, 0}, 0, 0.25, 0.25), ball_at({}, 0.5, 0, 0)},
      {"a moving ball after its way", ball_at(Vec3d{0, 2, 0}, 0, 1.5, 1.5), ball_at({}, 3, 0, 0)},
      {"a focus without defocus", focused(0, 8 * looked_at), focused(0, {})},
      {"a focus where the camera looks", focused(2, looked_at), focused(2, {})}};
  for (const auto& pair : pairs)
    for (const Kernels& kernels : available_kernels()) {
      CAPTURE(pair.name);
      CAPTURE(kernels.isa);
      CHECK(resolve(film_of(pair.one, 8, kernels.isa)) == resolve(film_of(pair.other, 8, kernels.isa)));
    }
  CHECK(resolve(film_of(focused(2, {}), 8)) != resolve(film_of(focused(0, {}), 8)));
}

TEST_CASE("equal scenes: with and without the tree every built-in scene's picture is the same, bit for bit") {
  for (const BuiltIn& built_in : built_in_scenes()) {
    RenderScene compiled = compile(small_scene(built_in.name, 16, 12, 2));
    if (compiled.bvh.nodes.empty()) continue;
    const Film film = render(compiled, {.spp = 2}).film;
    compiled.bvh = {};
    CAPTURE(built_in.name);
    CHECK(render(compiled, {.spp = 2}).film == film);
  }
}

}  // namespace tyndall::test::equal_scenes_test
