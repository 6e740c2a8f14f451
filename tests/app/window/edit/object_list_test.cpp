#include "app/window/edit/object_list.h"

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

}  // namespace tyndall::test::object_list_test
