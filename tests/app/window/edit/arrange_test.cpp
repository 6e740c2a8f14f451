#include "app/window/edit/arrange.h"

#include <doctest/doctest.h>

namespace tyndall::test::arrange_test {

namespace {

Scene scene_of(std::vector<Object> objects) {
  Scene scene;
  scene.materials = {{"grey", Vec3d{0.5, 0.5, 0.5}, Lambertian<>{}}};
  scene.objects = std::move(objects);
  return scene;
}
Object box(Vec3d min, Vec3d max, Transform transform = {}) { return {"box", Solid3d{Box<>{min, max}, 0}, transform}; }
const Box<>& box_of(const Scene& scene) { return std::get<Box<>>(std::get<Solid3d>(scene.objects[0].kind).shape); }

}  // namespace

TEST_CASE("moving changes the numbers that a person would change") {
  SUBCASE("a sphere's centre, and where it moves to") {
    Scene scene = scene_of({{"", Solid3d{Sphere<>{{0, 1, 0}, 1, Vec3d{0, 1.5, 0}}, 0}, {}}});
    set_anchor(scene, {0}, anchor_of(scene, {0}) + Vec3d{0.1, 0.2, 0});
    const auto& sphere = std::get<Sphere<>>(std::get<Solid3d>(scene.objects[0].kind).shape);
    CHECK(sphere.center == Vec3d{0.1, 1.2, 0});
    CHECK(*sphere.center_end == Vec3d{0.1, 1.7, 0});
  }
  SUBCASE("both corners of a box, without the noise of sums") {
    Scene scene = scene_of({box({0.1, 0, 0}, {0.2, 1, 1})});
    set_anchor(scene, {0}, {0.3, 0, 0});
    CHECK(box_of(scene).min == Vec3d{0.3, 0, 0});
    CHECK(box_of(scene).max == Vec3d{0.4, 1, 1});
  }
  SUBCASE("the shift at the end of a transform, not the shape") {
    Scene scene = scene_of({box({0, 0, 0}, {165, 330, 165}, {RotateY{15}, Translate{{265, 0, 295}}})});
    CHECK(anchor_of(scene, {0}) == Vec3d{265, 0, 295});
    set_anchor(scene, {0}, {270, 0, 295});
    CHECK(scene.objects[0].transform == Transform{RotateY{15}, Translate{{270, 0, 295}}});
    CHECK(box_of(scene).min == Vec3d{0, 0, 0});
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
  CHECK(box_of(scene).min == Vec3d{-1, 0, -2});
  CHECK(box_of(scene).max == Vec3d{1, 1, 2});
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

}  // namespace tyndall::test::arrange_test
