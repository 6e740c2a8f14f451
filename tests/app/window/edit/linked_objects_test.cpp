
#include "app/window/edit/arrange.h"

#include <doctest/doctest.h>

namespace tyndall::test::linked_objects_test {

namespace {

Object ball(Vec3d center, double radius, int material) {
  return {"", Solid3d{Sphere<>{center, radius, {}}, material}, {}};
}
Object fog(std::variant<Sphere<>, Box<>> boundary, Transform transform = {}) {
  return {"", Volume{boundary, {}, {}, {}}, std::move(transform)};
}
Sphere<>& sphere(Scene& scene, std::size_t k) {
  return std::get<Sphere<>>(std::get<Solid3d>(scene.objects[k].kind).shape);
}
const Sphere<>& medium_sphere(Scene& scene, std::size_t k) {
  return std::get<Sphere<>>(std::get<Volume>(scene.objects[k].kind).boundary);
}

/// A shell of glass with media in it, a sphere of grey around the same centre, and another one elsewhere.
Scene shell() {
  Scene scene;
  scene.materials = {{"grey", Vec3d{0.5, 0.5, 0.5}, Lambertian<>{}}, {"glass", {}, Dielectric<>{}}};
  scene.objects = {ball({0.1, 1, 0}, 1, 1), ball({0.1, 1, 0}, -0.9, 1), fog(Sphere<>{{0.1, 1, 0}, 1, {}}),
                   ball({0.1, 1, 0}, 0.3, 0), ball({5, 1, 0}, 0.3, 1)};
  return scene;
}

}  // namespace

TEST_CASE("a ball of glass has the fog that fills it and the spheres within as companions, a matt one only the fog") {
  Scene scene = shell();
  CHECK(linked_objects(scene, {0}) == std::vector<ObjectPath>{{1}, {2}, {3}});
  CHECK(linked_objects(scene, {1}) == std::vector<ObjectPath>{{3}});
  CHECK(linked_objects(scene, {2}).empty());
  CHECK(linked_objects(scene, {4}).empty());
  std::get<Solid3d>(scene.objects[0].kind).material = 0;
  CHECK(linked_objects(scene, {0}) == std::vector<ObjectPath>{{2}});
}

TEST_CASE("companions follow exactly: the same centre, fog the very numbers, inner spheres the proportion") {
  const Scene before = shell();
  Scene after = before;
  sphere(after, 0) = {{0.4, 1.2, -1}, 2, {}};
  move_linked_objects(before, before, after);
  CHECK(sphere(after, 1) == Sphere<>{{0.4, 1.2, -1}, -1.8, {}});
  CHECK(medium_sphere(after, 2) == sphere(after, 0));
  CHECK(sphere(after, 3) == Sphere<>{{0.4, 1.2, -1}, 0.6, {}});
  CHECK(after.objects[4] == before.objects[4]);
}

TEST_CASE("a companion that is changed itself leaves its ball alone") {
  const Scene before = shell();
  Scene after = before;
  sphere(after, 1).radius = -0.5;
  move_linked_objects(before, before, after);
  CHECK(after.objects[0] == before.objects[0]);
  CHECK(sphere(after, 1).radius == -0.5);
}

TEST_CASE("fog in a box takes over the box's turn") {
  Scene before;
  before.materials = {{"grey", Vec3d{0.5, 0.5, 0.5}, Lambertian<>{}}};
  const Box<> box{{0, 0, 0}, {1, 2, 1}};
  before.objects = {{"", Solid3d{box, 0}, {}}, fog(box)};
  Scene after = before;
  rotate_object(after, {0}, 30);
  move_linked_objects(before, before, after);
  CHECK(placement_at(after, {1}) == placement_at(after, {0}));
  CHECK(linked_objects(after, {0}) == std::vector<ObjectPath>{{1}});
}

TEST_CASE("nothing adds up over the drawings of a drag: the companions follow from where it began") {
  const Scene before = shell();
  Scene now = before;
  GestureStart start;
  for (int k = 1; k <= 1000; ++k) {
    Scene next = now;
    sphere(next, 0).radius = 1 + 0.003 * k / 7;
    start.finish_edit(std::make_shared<const Scene>(now), next, 5);
    now = next;
  }
  Scene next = now;
  sphere(next, 0).radius = 1;
  start.finish_edit(std::make_shared<const Scene>(now), next, 5);
  CHECK(next == before);
}

}  // namespace tyndall::test::linked_objects_test
