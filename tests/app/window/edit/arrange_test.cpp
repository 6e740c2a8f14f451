#include "app/window/edit/arrange.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <memory>
#include <utility>

namespace tyndall::test::arrange_test {

namespace {

Scene scene_of(std::vector<Object> objects) {
  Scene scene;
  scene.materials = {{"grey", Vec3d{0.5, 0.5, 0.5}, Lambertian<>{}}};
  scene.objects = std::move(objects);
  return scene;
}
Object solid(decltype(Solid3d::shape) shape, Transform transform = {}) { return {"", Solid3d{shape, 0}, transform}; }
Object box(Vec3d min, Vec3d max, Transform transform = {}) { return solid(Box<>{min, max}, std::move(transform)); }
template <class Shape>
const Shape& first_shape(const Scene& scene) {
  return std::get<Shape>(std::get<Solid3d>(scene.objects[0].kind).shape);
}

}  // namespace

TEST_CASE("moving changes the numbers that a person would change") {
  SUBCASE("a sphere's centre, and where it moves to") {
    Scene scene = scene_of({solid(Sphere<>{{0, 1, 0}, 1, Vec3d{0, 1.5, 0}})});
    set_anchor(scene, {0}, anchor_of(scene, {0}) + Vec3d{0.1, 0.2, 0});
    const auto& sphere = first_shape<Sphere<>>(scene);
    CHECK(sphere.center == Vec3d{0.1, 1.2, 0});
    CHECK(*sphere.center_end == Vec3d{0.1, 1.7, 0});
  }
  SUBCASE("both corners of a box, without the noise of sums") {
    Scene scene = scene_of({box({0.1, 0, 0}, {0.2, 1, 1})});
    set_anchor(scene, {0}, {0.3, 0, 0});
    CHECK(first_shape<Box<>>(scene).min == Vec3d{0.3, 0, 0});
    CHECK(first_shape<Box<>>(scene).max == Vec3d{0.4, 1, 1});
  }
  SUBCASE("the shift at the end of a transform, not the shape") {
    Scene scene = scene_of({box({0, 0, 0}, {165, 330, 165}, {RotateY{15}, Translate{{265, 0, 295}}})});
    CHECK(anchor_of(scene, {0}) == Vec3d{265, 0, 295});
    set_anchor(scene, {0}, {270, 0, 295});
    CHECK(scene.objects[0].transform == Transform{RotateY{15}, Translate{{270, 0, 295}}});
    CHECK(first_shape<Box<>>(scene).min == Vec3d{0, 0, 0});
  }
  SUBCASE("a new shift behind a turn, and of a group") {
    Scene scene = scene_of({box({0, 0, 0}, {1, 1, 1}, {RotateY{15}}), {"", Group{{box({0, 0, 0}, {1, 1, 1})}}, {}}});
    set_anchor(scene, {0}, {1, 0, 0});
    CHECK(scene.objects[0].transform == Transform{RotateY{15}, Translate{{1, 0, 0}}});
    set_anchor(scene, {1}, {0, 2, 0});
    CHECK(scene.objects[1].transform == Transform{Translate{{0, 2, 0}}});
  }
  SUBCASE("a medium's boundary, by its own transform") {
    Scene scene = scene_of({{"", Volume{Box<>{{0, 0, 0}, {1, 1, 1}}, {Translate{{5, 0, 0}}}, {}, {}}, {}}});
    set_anchor(scene, {0}, {6, 0, 0});
    CHECK(std::get<Volume>(scene.objects[0].kind).boundary_transform == Transform{Translate{{6, 0, 0}}});
    CHECK(scene.objects[0].transform.empty());
  }
}

TEST_CASE("turning keeps the middle where it is, and puts a plain shape around the origin first") {
  Scene scene = scene_of({box({1, 0, 2}, {3, 1, 6})});
  const Vec3d middle = middle_of(scene, {0});
  rotate_object(scene, {0}, 30);
  CHECK(scene.objects[0].transform == Transform{RotateY{30}, Translate{{2, 0, 4}}});
  CHECK(first_shape<Box<>>(scene).min == Vec3d{-1, 0, -2});
  CHECK(first_shape<Box<>>(scene).max == Vec3d{1, 1, 2});
  CHECK(length(middle_of(scene, {0}) - middle) < 1e-12);
  rotate_object(scene, {0}, 340);
  CHECK(angle_of(scene, {0}) == 10);
  CHECK(length(middle_of(scene, {0}) - middle) < 1e-12);
  rotate_object(scene, {0}, 180);
  CHECK(angle_of(scene, {0}) == -170);
  rotate_object(scene, {0}, 170);
  CHECK(scene.objects[0].transform == Transform{Translate{{2, 0, 4}}});
}

TEST_CASE("a shape that is not in the middle of its frame turns about its own middle, within groups, too") {
  Scene scene = scene_of(
      {{"", Group{{box({0, 0, 0}, {165, 330, 165}, {RotateY{15}, Translate{{265, 0, 295}}})}}, {RotateY{40}}}});
  const Vec3d middle = middle_of(scene, {0, 0});
  rotate_object(scene, {0, 0}, 25);
  CHECK(angle_of(scene, {0, 0}) == 40);
  CHECK(length(middle_of(scene, {0, 0}) - middle) < 1e-3);
  const Vec3d whole = middle_of(scene, {0});
  rotate_object(scene, {0}, 90);
  CHECK(length(middle_of(scene, {0}) - whole) < 1e-3);
  CHECK(angle_of(scene, {0}) == 130);
}

TEST_CASE("a sphere's grip is its radius, which keeps its sign") {
  Scene scene = scene_of({solid(Sphere<>{{1, 2, 3}, -0.5, {}})});
  const auto grips = size_grips(scene, {0}, {0, 1, 0});
  REQUIRE(grips.size() == 1);
  CHECK(grips[0].at == Vec3d{1, 2.5, 3});
  CHECK(grips[0].value == 0.5);
  set_size(scene, {0}, 0, 0.75, 0.01);
  CHECK(first_shape<Sphere<>>(scene).radius == -0.75);
  set_size(scene, {0}, 0, -3, 0.01);
  CHECK(first_shape<Sphere<>>(scene).radius == -0.01);
}

TEST_CASE("a box's grips are its faces, turned with it; the face opposite stays") {
  Scene scene = scene_of({solid(Box<>{{0, 0, 0}, {2, 1, 1}}, {RotateY{90}, Translate{{0, 5, 0}}})});
  const auto grips = size_grips(scene, {0}, {0, 1, 0});
  REQUIRE(grips.size() == 6);
  CHECK(length(grips[0].pull - Vec3d{0, 0, -1}) < 1e-12);
  CHECK(length(grips[0].at - Vec3d{0.5, 5.5, -2}) < 1e-12);
  for (std::size_t k = 0; k < 6; ++k) {
    Scene larger = scene;
    set_size(larger, {0}, k, grips[k].value + 1, 0.1);
    CHECK(size_grips(larger, {0}, {0, 1, 0})[k].value == grips[k].value + 1);
    CHECK(size_grips(larger, {0}, {0, 1, 0})[k ^ 1].value == grips[k ^ 1].value);
    set_size(larger, {0}, k, -100, 0.1);  // beyond the other face
    const Box<>& box = first_shape<Box<>>(larger);
    const Vec3d edges = box.max - box.min;
    CHECK(std::min({edges.x, edges.y, edges.z}) == doctest::Approx(0.1));
  }
}

TEST_CASE("a triangle's grips are at its corners, a disk's at the ends of its half axes, a ring's also at its hole") {
  Scene scene = scene_of({solid(Triangle<>{{0, 0, 0}, {3, 0, 4}, {0, 2, 0}})});
  auto grips = size_grips(scene, {0}, {0, 1, 0});
  REQUIRE(grips.size() == 2);
  CHECK(grips[0].at == Vec3d{3, 0, 4});
  CHECK(grips[0].value == 5);
  set_size(scene, {0}, 1, 3, 0.1);
  CHECK(first_shape<Triangle<>>(scene).v == Vec3d{0, 3, 0});
  scene = scene_of({solid(Disk<>{{0, 1, 0}, {2, 0, 0}, {0, 0, 1}, 0})});
  CHECK(size_grips(scene, {0}, {0, 1, 0}).size() == 2);
  scene = scene_of({solid(Disk<>{{0, 1, 0}, {2, 0, 0}, {0, 0, 1}, 0.5})});
  grips = size_grips(scene, {0}, {0, 1, 0});
  REQUIRE(grips.size() == 3);
  CHECK(grips[1].at == Vec3d{0, 1, 1});
  CHECK(grips[2].at == Vec3d{-1, 1, 0});
  CHECK(grips[2].value == 1);
  set_size(scene, {0}, 0, 4, 0.1);
  CHECK(first_shape<Disk<>>(scene).u == Vec3d{4, 0, 0});
  set_size(scene, {0}, 2, 1, 0.1);
  CHECK(first_shape<Disk<>>(scene).inner == 0.25);
  set_size(scene, {0}, 2, 100, 0.1);  // beyond the rim
  CHECK(first_shape<Disk<>>(scene).inner == 0.99);
}

TEST_CASE("a quad's grips are the lengths of its edges") {
  Scene scene = scene_of({solid(Quad<>{{0, 0, 0}, {3, 0, 4}, {0, 2, 0}})});
  const auto grips = size_grips(scene, {0}, {0, 1, 0});
  REQUIRE(grips.size() == 2);
  CHECK(grips[0].value == 5);
  set_size(scene, {0}, 0, 10, 0.1);
  CHECK(first_shape<Quad<>>(scene).u == Vec3d{6, 0, 8});
  CHECK(first_shape<Quad<>>(scene).v == Vec3d{0, 2, 0});
}

TEST_CASE("groups have no grips") {
  Scene scene;
  scene.objects = {{"", Group{}, {}}};
  CHECK(size_grips(scene, {0}, {0, 1, 0}).empty());
  CHECK(size_grips(scene, {3}, {0, 1, 0}).empty());
}

namespace {

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
  const auto ball = [](Vec3d center, double radius, int material) {
    return Object{"", Solid3d{Sphere<>{center, radius, {}}, material}, {}};
  };
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

}  // namespace tyndall::test::arrange_test
