#include "tests/support/probe.h"

#include <doctest/doctest.h>

namespace tyndall::test::motion_test {

namespace {

/// A black sphere of radius 1/2 that moves from the origin up by 2 while the shutter is open.
Scene moving_sphere(double y) {
  Scene scene = white_room();
  add(scene, Sphere<>{{0, 0, 0}, 0.5, Vec3d{0, 2, 0}}, lambertian(0));
  aim(scene, {0, 0, 5}, {0, y, 0});
  scene.camera.shutter_close = 1;
  return scene;
}

}  // namespace

TEST_CASE("motion: the shutter's times count, also a part, an instant and times beyond 1") {
  Scene scene = moving_sphere(1.0);
  ZScores scores;
  scene.camera.shutter_open = 0.25, scene.camera.shutter_close = 0.75;  // within 0.245 … 0.755 the centre covers it
  CHECK(common_value(scene) == 0);
  scene.camera.shutter_open = 0.0, scene.camera.shutter_close = 0.5;
  scores.add("first half", radiance(scene, 256), 1 - 0.5099019513592784, 0.01);
  scene.camera.shutter_open = scene.camera.shutter_close = 0.5;
  CHECK(common_value(scene) == 0);
  scene.camera.shutter_open = scene.camera.shutter_close = 0.2;
  CHECK(common_value(scene) == 1);
  aim(scene, {0, 0, 5}, {0, 4, 0});
  scene.camera.shutter_open = scene.camera.shutter_close = 2;
  CHECK(common_value(scene) == 0);
}

TEST_CASE("motion: a ball whose two centres are equal is at rest") {
  Scene moving = white_room();
  moving.background = Gradient{};
  moving.camera = {.look_from = {0, 0.4, 3}, .look_at = {0, 0, 0}, .shutter_close = 1};
  Scene still = moving;
  add(moving, Sphere<>{{0, 0, 0}, 1, Vec3d{0, 0, 0}}, lambertian(0.5));
  add(still, sphere({0, 0, 0}, 1), lambertian(0.5));
  CHECK(resolve(film_of(moving, 4)) == resolve(film_of(still, 4)));
}

}  // namespace tyndall::test::motion_test
