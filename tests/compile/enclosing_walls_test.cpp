#include "core/compile/surroundings.h"
#include "core/scene/load.h"

#include <doctest/doctest.h>

namespace tyndall::test::enclosing_walls_test {

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

Sphere<> ball(Vec3d center, double radius) {
  Sphere<> s;
  s.center = center, s.radius = radius;
  return s;
}

}  // namespace

TEST_CASE("hull: a quad bounds a scene that lies on either side of it, wherever it is placed") {
  const Camera camera;
  for (const Placement& placement : {Placement{}, Placement{37, {100, -3, 8}}}) {
    CHECK(bounds_scene(square_and(ball({1, 5, 0}, 1), placement), 0, camera));
    CHECK(bounds_scene(square_and(ball({-3, 0, 0}, 2), placement), 0, camera));
    CHECK_FALSE(bounds_scene(square_and(ball({0.999, 5, 0}, 1), placement), 0, camera));
    CHECK_FALSE(bounds_scene(square_and(ball({0, 0, 0}, 0.5), placement), 0, camera));
  }
  CHECK_FALSE(bounds_scene(square_and(ball({1, 0, 0}, 1)), 1, camera));  // not a quad
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
  Sphere<> moving = ball({2, 0, 0}, 1);
  moving.center_end = Vec3d{-2, 0, 0};
  camera.shutter_open = 0, camera.shutter_close = 0.2;
  CHECK(bounds_scene(square_and(moving), 0, camera));
  camera.shutter_close = 0.5;
  CHECK_FALSE(bounds_scene(square_and(moving), 0, camera));
  Flattened fog = square_and(ball({2, 0, 0}, 1));
  CHECK(bounds_scene(fog, 0, camera));
  fog.volumes.push_back({ball({0, 0, 0}, 1), {}, {}, Vec3d{1, 1, 1}, {}});
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

}  // namespace tyndall::test::enclosing_walls_test
