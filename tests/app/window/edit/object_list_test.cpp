#include "app/window/edit/object_list.h"

#include "app/window/edit/arrange.h"
#include "core/scene/check.h"
#include "core/scene/load.h"

#include <doctest/doctest.h>

namespace tyndall::test::object_list_test {

namespace {

Object ball(const std::string& name, double x, int material = 0, double radius = 1) {
  return {name, Solid3d{Sphere<>{{x, 0, 0}, radius, {}}, material}, {}};
}
std::vector<std::string> names(const std::vector<Object>& objects) {
  std::vector<std::string> result;
  for (const Object& object : objects) result.push_back(object.name);
  return result;
}

Scene example() {
  Scene scene;
  scene.materials = {{"grey", Vec3d{0.5, 0.5, 0.5}, Lambertian<>{}}, {"glass", {}, Dielectric<>{}}};
  scene.objects = {ball("a", 0),
                   ball("shell", 5, 1),
                   ball("bubble", 5, 1, -0.5),
                   {"pair", Group{{ball("c", 10), ball("d", 15)}}, {}},
                   ball("e", 20)};
  return scene;
}

Scene floor_and_box() {
  Scene scene;
  scene.width = 200, scene.height = 100;
  scene.camera.look_from = {0, 1, 10};
  scene.camera.look_at = {0, 1, 0};
  scene.camera.vfov = 53.13;  // a picture as high as far
  scene.materials = {{"floor", Vec3d{0.5, 0.5, 0.5}, Lambertian<>{}}};
  scene.objects = {{"floor", Solid3d{Quad<>{{-50, 0, -50}, {100, 0, 0}, {0, 0, 100}}, 0}, {}},
                   {"box", Solid3d{Box<>{{-1, 0, -1}, {1, 1, 1}}, 0}, {RotateY{90}}}};
  return scene;
}

}  // namespace

TEST_CASE("what is in a selected group is not edited twice") {
  CHECK(outermost({{3, 1}, {0}, {3}, {0}}) == ObjectPaths{{0}, {3}});
  CHECK(outermost({{3, 1}, {3, 0}}) == ObjectPaths{{3, 0}, {3, 1}});
  CHECK(outermost({}).empty());
}

TEST_CASE("copies stand behind what they are copies of, with names of their own, and companions come along") {
  Scene scene = example();
  CHECK(duplicate_objects(scene, {{1}, {0}}) == ObjectPaths{{1}, {3}, {5}});
  CHECK(names(scene.objects) ==
        std::vector<std::string>{"a", "a 2", "shell", "shell 2", "bubble", "bubble 2", "pair", "e"});
  CHECK(scene.objects[3].kind == scene.objects[2].kind);
}

TEST_CASE("copies in groups stay in their groups") {
  Scene scene = example();
  CHECK(duplicate_objects(scene, {{3, 0}, {4}}) == ObjectPaths{{3, 1}, {5}});
  CHECK(names(std::get<Group>(scene.objects[3].kind).objects) == std::vector<std::string>{"c", "c 2", "d"});
}

TEST_CASE("free names count on") {
  const Scene scene = example();
  CHECK(free_name(scene, "new") == "new");
  CHECK(free_name(scene, "c") == "c 2");
  Scene more = scene;
  more.objects[0].name = "c 2";
  CHECK(free_name(more, "c 2") == "c 3");
  CHECK(free_name(more, "c") == "c 3");
}

TEST_CASE("deleting takes companions along, and materials that only the window has made") {
  Scene scene = example();
  const std::vector<Material> written = {scene.materials[0]};
  CHECK(delete_objects(scene, {{1}}, written) == 2);
  CHECK(names(scene.objects) == std::vector<std::string>{"a", "pair", "e"});
  CHECK(scene.materials.size() == 1);  // nothing is of glass any more
  Scene other = example();
  std::swap(other.materials[0], other.materials[1]);  // the spheres are of glass, the shells grey
  CHECK(delete_objects(other, {{0}, {3}, {4}}, {}) == 3);
  CHECK(other.materials.size() == 1);
  CHECK(std::get<Solid3d>(other.objects[0].kind).material == 0);
  Scene kept = example();
  CHECK(delete_objects(kept, {{1}}, kept.materials) == 2);
  CHECK(kept.materials.size() == 2);
}

TEST_CASE("everything that can be added gives a valid scene that reads back the same, and selects something") {
  for (const Addition& what : additions()) {
    Scene scene = floor_and_box();
    const ObjectPaths added = what.add(scene, {{0.123456, 0, 0.3}, {0, 1, 0}, 0.5});
    REQUIRE_FALSE(added.empty());
    CHECK(find_object(scene, added.front()) != nullptr);
    CHECK_FALSE(check(scene).has_value());
    CHECK(read_scene(write_scene(scene), "added", ".") == scene);
  }
}

TEST_CASE("a ball stands on the spot, by numbers that print short") {
  Scene scene = floor_and_box();
  addition_named("a sphere").add(scene, {{0.123456, 0.0000001, 0.3}, {0, 1, 0}, 0.5});
  const auto& ball = std::get<Sphere<>>(std::get<Solid3d>(scene.objects.back().kind).shape);
  CHECK(ball.radius == 0.25);
  CHECK(ball.center == Vec3d{0.123, 0.25, 0.3});
  CHECK(scene.objects.back().name == "ball");
  CHECK(scene.materials.back().name == "matt");
  addition_named("a sphere").add(scene, {{1, 0, 0}, {0, 1, 0}, 0.5});
  CHECK(scene.objects.back().name == "ball 2");
  CHECK(scene.materials.size() == 2);  // both have the same material
}

TEST_CASE("a material of the usual name but with other values is left alone") {
  Scene scene = floor_and_box();
  scene.materials.push_back({"matt", Vec3d{1, 0, 0}, Lambertian<>{}});
  addition_named("a box").add(scene, {});
  CHECK(scene.materials.size() == 3);
  CHECK(scene.materials.back().name == "matt 2");
}

TEST_CASE("a hollow ball's inside goes along with it") {
  Scene scene = floor_and_box();
  const ObjectPaths added = addition_named("a hollow ball").add(scene, {});
  REQUIRE(added.size() == 2);
  CHECK(linked_objects(scene, added[0]) == ObjectPaths{added[1]});
}

TEST_CASE("a spot is on the side of the surface that is seen, and as large as suits the distance") {
  const Scene scene = floor_and_box();
  CHECK(normal_at(scene, {0}, {3, 0, 3}) == Vec3d{0, 1, 0});
  CHECK(length(normal_at(scene, {1}, {0, 0.5, 1}) - Vec3d{0, 0, 1}) < 1e-12);
  CHECK(length(normal_at(scene, {1}, {0.2, 1, 0.2}) - Vec3d{0, 1, 0}) < 1e-12);
  const Spot on_floor = spot_at(scene, {0.5, 0.6}, {0}, {0, 0, 0});
  CHECK(on_floor.size == doctest::Approx(1));  // at most a fifth of 10, as a round number: 2 is just too much
  CHECK(on_floor.point == Vec3d{0, 0, 0});
  const Spot in_air = spot_at(scene, {0.5, 0.5}, {}, {});
  CHECK(length(in_air.point - Vec3d{0, 1, 0}) < 1e-9);
}

}  // namespace tyndall::test::object_list_test
