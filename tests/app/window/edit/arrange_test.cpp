#include "app/window/edit/arrange.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
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

TEST_CASE("grains are 1, 2 or 5 times a power of ten, and never larger than asked for") {
  CHECK(nice_below(0.7).size() == 0.5);
  CHECK(nice_below(0.5).size() == 0.5);
  CHECK(nice_below(3.9).size() == 2);
  CHECK(nice_below(1000).size() == 1000);
  CHECK(nice_below(0.00199).size() == doctest::Approx(0.001));
  CHECK(decimal_below(99).size() == 10);
  CHECK(decimal_below(0.1).size() == doctest::Approx(0.1));
}

TEST_CASE("rounded numbers are those that a person would type") {
  CHECK(rounded(0.30000000000000004, DragRounding{1, -2}) == 0.3);
  CHECK(rounded(0.1234, DragRounding{5, -2}) == 0.1);
  CHECK(rounded(0.13, DragRounding{5, -2}) == 0.15);
  CHECK(rounded(1234.6, DragRounding{2, 1}) == 1240);
  CHECK_FALSE(std::signbit(rounded(-0.001, DragRounding{1, -2})));
  CHECK(without_noise(0.1 + 0.2) == 0.3);
  CHECK(without_noise(1e-7 / 3) == doctest::Approx(1e-7 / 3).epsilon(1e-11).scale(0));
  CHECK(without_noise(0) == 0);
}

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

}  // namespace tyndall::test::arrange_test
