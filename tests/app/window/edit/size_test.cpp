#include "app/window/edit/arrange.h"

#include <doctest/doctest.h>

#include <algorithm>

namespace tyndall::test::size_test {

namespace {

Scene scene_of(decltype(Solid3d::shape) shape, Transform transform = {}) {
  Scene scene;
  scene.materials = {{"grey", Vec3d{0.5, 0.5, 0.5}, Lambertian<>{}}};
  scene.objects = {{"", Solid3d{shape, 0}, std::move(transform)}};
  return scene;
}
template <class Shape>
const Shape& only_shape(const Scene& scene) {
  return std::get<Shape>(std::get<Solid3d>(scene.objects[0].kind).shape);
}

}  // namespace

TEST_CASE("a sphere's grip is its radius, which keeps its sign") {
  Scene scene = scene_of(Sphere<>{{1, 2, 3}, -0.5, {}});
  const auto grips = size_grips(scene, {0}, {0, 1, 0});
  REQUIRE(grips.size() == 1);
  CHECK(grips[0].at == Vec3d{1, 2.5, 3});
  CHECK(grips[0].value == 0.5);
  set_size(scene, {0}, 0, 0.75, 0.01);
  CHECK(only_shape<Sphere<>>(scene).radius == -0.75);
  set_size(scene, {0}, 0, -3, 0.01);
  CHECK(only_shape<Sphere<>>(scene).radius == -0.01);
}

TEST_CASE("a box's grips are its faces, turned with it; the face opposite stays") {
  Scene scene = scene_of(Box<>{{0, 0, 0}, {2, 1, 1}}, {RotateY{90}, Translate{{0, 5, 0}}});
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
    const Box<>& box = only_shape<Box<>>(larger);
    const Vec3d edges = box.max - box.min;
    CHECK(std::min({edges.x, edges.y, edges.z}) == doctest::Approx(0.1));
  }
}

TEST_CASE("a triangle's grips are at its corners, a disk's at the ends of its half axes, a ring's also at its hole") {
  Scene scene = scene_of(Triangle<>{{0, 0, 0}, {3, 0, 4}, {0, 2, 0}});
  auto grips = size_grips(scene, {0}, {0, 1, 0});
  REQUIRE(grips.size() == 2);
  CHECK(grips[0].at == Vec3d{3, 0, 4});
  CHECK(grips[0].value == 5);
  set_size(scene, {0}, 1, 3, 0.1);
  CHECK(only_shape<Triangle<>>(scene).v == Vec3d{0, 3, 0});
  scene = scene_of(Disk<>{{0, 1, 0}, {2, 0, 0}, {0, 0, 1}, 0});
  CHECK(size_grips(scene, {0}, {0, 1, 0}).size() == 2);
  scene = scene_of(Disk<>{{0, 1, 0}, {2, 0, 0}, {0, 0, 1}, 0.5});
  grips = size_grips(scene, {0}, {0, 1, 0});
  REQUIRE(grips.size() == 3);
  CHECK(grips[1].at == Vec3d{0, 1, 1});
  CHECK(grips[2].at == Vec3d{-1, 1, 0});
  CHECK(grips[2].value == 1);
  set_size(scene, {0}, 0, 4, 0.1);
  CHECK(only_shape<Disk<>>(scene).u == Vec3d{4, 0, 0});
  set_size(scene, {0}, 2, 1, 0.1);
  CHECK(only_shape<Disk<>>(scene).inner == 0.25);
  set_size(scene, {0}, 2, 100, 0.1);  // beyond the rim
  CHECK(only_shape<Disk<>>(scene).inner == 0.99);
}

TEST_CASE("a quad's grips are the lengths of its edges") {
  Scene scene = scene_of(Quad<>{{0, 0, 0}, {3, 0, 4}, {0, 2, 0}});
  const auto grips = size_grips(scene, {0}, {0, 1, 0});
  REQUIRE(grips.size() == 2);
  CHECK(grips[0].value == 5);
  set_size(scene, {0}, 0, 10, 0.1);
  CHECK(only_shape<Quad<>>(scene).u == Vec3d{6, 0, 8});
  CHECK(only_shape<Quad<>>(scene).v == Vec3d{0, 2, 0});
}

TEST_CASE("groups have no grips") {
  Scene scene;
  scene.objects = {{"", Group{}, {}}};
  CHECK(size_grips(scene, {0}, {0, 1, 0}).empty());
  CHECK(size_grips(scene, {3}, {0, 1, 0}).empty());
}

}  // namespace tyndall::test::size_test
