#include "core/render/caustics.h"

#include "core/scene/load.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace tyndall;

namespace {

/// A floor, a glass ball of radius 1, and a lamp `distance` above its centre.
Scene ball_under_lamp(double radius, double distance) {
  Scene scene;
  scene.materials = {{"floor", Vec3d{0.7, 0.7, 0.7}, Lambertian<>{}},
                     {"glass", Vec3d{1, 1, 1}, Dielectric<>{1.5}},
                     {"lamp", Vec3d{9, 9, 9}, Light<>{}}};
  scene.objects = {{"", Solid3d{Quad<>{{-5, -1, -5}, {10, 0, 0}, {0, 0, 10}}, 0}, {}},
                   {"", Solid3d{Sphere<>{{0, 0, 0}, 1, {}}, 1}, {}},
                   {"", Solid3d{Sphere<>{{0, distance, 0}, radius, {}}, 2}, {}}};
  return scene;
}

}  // namespace

TEST_CASE("caustics: the chance is the lamp's share of all directions, seen from the glass") {
  CHECK(chance_of_caustics(ball_under_lamp(0.03, 3)) == doctest::Approx(0.5 * (1 - std::sqrt(1 - 1e-4))));
  CHECK(chance_of_caustics(ball_under_lamp(1.5, 3)) == doctest::Approx(0.5 * (1 - std::sqrt(0.75))));
  CHECK(chance_of_caustics(ball_under_lamp(4, 3)) == 1);  // around the ball
}

TEST_CASE("caustics: none without something smooth that catches light, or something matt that shows it") {
  Scene scene = ball_under_lamp(0.03, 3);
  const double chance = chance_of_caustics(scene);
  scene.materials[1].kind = Metal<>{0};
  CHECK(chance_of_caustics(scene) == chance);
  scene.materials[1].kind = Metal<>{0.1};  // lights are sampled from it
  CHECK(chance_of_caustics(scene) == 1);
  scene = ball_under_lamp(0.03, 3);
  scene.materials[0].kind = Metal<>{0.1};
  CHECK(chance_of_caustics(scene) == 1);
  CHECK(chance_of_caustics(ball_under_lamp(0.03, 30)) == 1);  // the ball is too far to catch a hundredth of the light
  CHECK(chance_of_caustics(load_scene("cornell-box").scene) == 1);
}
