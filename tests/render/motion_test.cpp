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

constexpr double coverage[][2] = {{-0.4, 0.05079872407968904}, {0.0, 0.25},
                                  {0.3, 0.4004495957273638},   {1.0, 0.5099019513592784},
                                  {1.7, 0.4140549185302178},   {2.4, 0.07730849247724059}};

}  // namespace

TEST_CASE("motion: covers each point for its share of the time") {
  ZScores scores;
  std::uint32_t seed = 0;
  for (const auto& [y, fraction] : coverage)
    for (const int others : {0, 40}) {  // alone, and in a tree
      Scene scene = moving_sphere(y);
      for (int i = 0; i < others; ++i) add(scene, sphere({10.0 + i, 0, 0}, 0.3), lambertian(0.5));
      scene.render.seed = ++seed;
      scores.add("seen past it", radiance(scene, 256), 1 - fraction, 5e-3);
      if (others == 0) scores.add("scalar", radiance(scene, 32, "scalar"), 1 - fraction, 0.02);
    }
}

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

TEST_CASE("motion: a mirror sees the ball where it is at the path's own time") {
  // Seen in a mirror and directly at once, the sphere covers both or neither: their product's mean is the coverage, not
  // its square.
  Scene scene = moving_sphere(0.0);
  add(scene, Quad<>{{-50, -50, -5}, {100, 0, 0}, {0, 100, 0}}, metal(1, 0));
  aim(scene, {0, 0.3, 5}, {0, 0.3, -5});  // past the sphere, back from the mirror, past the sphere again
  scene.camera.shutter_close = 1;
  ZScores scores;
  // The sphere covers the ray while |2t - 0.3| < 0.5.
  scores.add("there and back", radiance(scene, 8192), 0.6, 1e-3);
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
