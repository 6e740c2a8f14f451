#include "core/compile/overlap.h"
#include "core/compile/surroundings.h"
#include "core/scene/load.h"
#include "tests/support/probe.h"

#include <doctest/doctest.h>

/// What stands where in a scene: what hides lights, what overlaps, which walls bound it.
namespace tyndall::test::visibility_test {

namespace {

constexpr Vec3d above{0, 5.2, 0};

/// A mirror sphere of radius 1 on the way from a light to the floor.
Scene sphere_under_light(double light_radius) {
  Scene scene = lit_floor(light_radius, above, 1);
  add(scene, sphere({0, 1.2, 0}, 1), metal(0.8, 0));
  return scene;
}

double fraction_of_first_light(const Scene& scene, const Sphere<>& ball) {
  const RenderScene compiled = compile(scene);
  return visible_fraction(list_obstacles(flatten(scene)), compiled.lights, 0, compiled.origin, round_body(ball, {}));
}
double fraction_of_first_light(const Scene& scene) { return fraction_of_first_light(scene, sphere({0, 1.2, 0}, 1)); }

}  // namespace

TEST_CASE("sight: what stands between a lamp and a ball hides a share of the lamp") {
  Scene scene = sphere_under_light(0.2);
  CHECK(fraction_of_first_light(scene) == 1);
  add(scene, Quad<>{{0, 3, -3}, {3, 0, 0}, {0, 0, 6}}, lambertian(0.5));
  CHECK(fraction_of_first_light(scene) == doctest::Approx(0.5).epsilon(0.05));
  add(scene, Box<>{{-3, 3, -3}, {0, 3.1, 3}}, lambertian(0.5));
  CHECK(fraction_of_first_light(scene) == 1.0 / 64);
}

TEST_CASE("sight: a small sphere hides as much of the ball as its shadow covers") {
  Scene scene = sphere_under_light(0.001);
  add(scene, sphere({0, 3.2, 0}, 0.2), lambertian(0.5));
  const double shadow = 4 * 0.1 / std::sqrt(1 - 0.1 * 0.1);  // its radius at the middle of the sphere
  CHECK(fraction_of_first_light(scene) == doctest::Approx(1 - shadow * shadow).epsilon(0.04));
}

TEST_CASE("sight: a ceiling behind a lamp, glass around it and things behind the ball hide nothing") {
  Scene scene = dark_room();
  add(scene, Quad<>{{-6, 0, -6}, {12, 0, 0}, {0, 0, 12}}, lambertian(0.7));
  add(scene, Quad<>{{-6, 6, -6}, {12, 0, 0}, {0, 0, 12}}, lambertian(0.7));
  add(scene, Quad<>{{-0.5, 5.999, -0.5}, {1, 0, 0}, {0, 0, 1}}, lamp(1));
  add(scene, sphere({0, 6, 0}, 1), glass(1.5));
  add(scene, sphere({0, 1.2, 0}, 1), glass(1.5));
  add(scene, sphere({0, 1.2, 0}, -0.9), glass(1.5));
  CHECK(fraction_of_first_light(scene) == 1);
  CHECK(fraction_of_first_light(scene, sphere({0, 6, 0}, 1)) == 1);  // the light is within
}

TEST_CASE("sight: chains ask less for a lamp that the ball does not see") {
  Scene scene = sphere_under_light(0.2);
  const auto worth = [&] {
    const RenderScene compiled = compile(scene);
    REQUIRE(compiled.specular.sphere.size() == 1);
    return compiled.specular.choice.power[0];
  };
  const float before = worth();
  add(scene, Quad<>{{-3, 3, -3}, {6, 0, 0}, {0, 0, 6}}, lambertian(0.5));
  CHECK(worth() == doctest::Approx(before / 8));
}

TEST_CASE("overlap: a ball within another one, which it does not touch, is none") {
  Scene scene = dark_room();
  add(scene, sphere({0, 0, 0}, 2), glass(1.5));
  const Flattened flat = flatten(scene);
  CHECK_FALSE(is_overlapped(flat, round_body(sphere({0, 0, 0}, 1), {}), {}));
  CHECK(is_overlapped(flat, round_body(sphere({1.5, 0, 0}, 1), {}), {}));
  CHECK_FALSE(is_overlapped(flat, round_body(sphere({3.5, 0, 0}, 1), {}), {}));
}

namespace {

/// A square at x = 0 that faces +x, and one shape more.
template <class S>
Flattened square_and(const S& other, Placement placement = {}) {
  Flattened flat;
  Quad<> square;
  square.corner = {0, -1, -1}, square.u = {0, 2, 0}, square.v = {0, 0, 2};
  flat.shapes.push_back({square, placement, 0, {}});
  flat.shapes.push_back({other, placement, 0, {}});
  return flat;
}

}  // namespace

TEST_CASE("hull: a quad bounds a scene that lies on either side of it, wherever it is placed") {
  const Camera camera;
  for (const Placement& placement : {Placement{}, Placement{37, {100, -3, 8}}}) {
    CHECK(bounds_scene(square_and(sphere({1, 5, 0}, 1), placement), 0, camera));
    CHECK(bounds_scene(square_and(sphere({-3, 0, 0}, 2), placement), 0, camera));
    CHECK_FALSE(bounds_scene(square_and(sphere({0.999, 5, 0}, 1), placement), 0, camera));
    CHECK_FALSE(bounds_scene(square_and(sphere({0, 0, 0}, 0.5), placement), 0, camera));
  }
  CHECK_FALSE(bounds_scene(square_and(sphere({1, 0, 0}, 1)), 1, camera));  // not a quad
}

TEST_CASE("hull: boxes, other quads, motion and media count") {
  Camera camera;
  Box<> box;
  box.min = {0, 0, 0}, box.max = {1, 2, 3};
  CHECK(bounds_scene(square_and(box), 0, camera));
  box.min.x = -0.01;
  CHECK_FALSE(bounds_scene(square_and(box), 0, camera));
  Quad<> tilted;
  tilted.corner = {0, 0, 0}, tilted.u = {1, 1, 0}, tilted.v = {0, 0, 1};
  CHECK(bounds_scene(square_and(tilted), 0, camera));
  tilted.u.x = -1;
  CHECK(bounds_scene(square_and(tilted), 0, camera));
  tilted.corner.x = 0.5;
  CHECK_FALSE(bounds_scene(square_and(tilted), 0, camera));
  Quad<> lamp;  // in the wall's plane: shadow rays need the wall, because ties decide which of the two is met
  lamp.corner = {0, 0, 0}, lamp.u = {0, 0.5, 0}, lamp.v = {0, 0, 0.5};
  CHECK_FALSE(bounds_scene(square_and(lamp), 0, camera));
  lamp.corner.x = 1e-3;
  CHECK(bounds_scene(square_and(lamp), 0, camera));
  Sphere<> moving = sphere({2, 0, 0}, 1);
  moving.center_end = Vec3d{-2, 0, 0};
  camera.shutter_open = 0, camera.shutter_close = 0.2;
  CHECK(bounds_scene(square_and(moving), 0, camera));
  camera.shutter_close = 0.5;
  CHECK_FALSE(bounds_scene(square_and(moving), 0, camera));
  Flattened fog = square_and(sphere({2, 0, 0}, 1));
  CHECK(bounds_scene(fog, 0, camera));
  fog.volumes.push_back({sphere({0, 0, 0}, 1), {}, {}, Vec3d{1, 1, 1}, {}});
  CHECK_FALSE(bounds_scene(fog, 0, camera));
}

TEST_CASE("hull: the walls of the Cornell box, not its light") {
  const Scene scene = load_scene("cornell-box").scene;
  const Flattened flat = flatten(scene);
  int walls = 0, others = 0;
  for (std::size_t i = 0; i < flat.shapes.size(); ++i) (bounds_scene(flat, i, scene.camera) ? walls : others) += 1;
  CHECK(walls == 5);
  CHECK(others == 3);
}

}  // namespace tyndall::test::visibility_test
