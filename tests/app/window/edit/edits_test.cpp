#include "app/window/edit/arrange.h"
#include "app/window/edit/material_edits.h"
#include "app/window/edit/object_list.h"
#include "core/scene/check.h"
#include "core/scene/load.h"
#include "tests/app/window/scenes.h"

namespace tyndall::test::edits_test {

namespace {

constexpr int lambertian = 0, metal = 1, dielectric = 2, light = 3, medium_within = 4;

/// Two balls of gold, one of glass, and a quad of it; their types are changed.
struct Typed {
  Scene scene =
      scene_of({ball("b", {0, 0, 0}), ball("b", {3, 0, 0}), ball("b", {6, 0, 0}, 1, 1), solid(Quad<>{}, {}, 1)});
  MaterialMemory memory;

  Typed() { scene.materials = {{"gold", Vec3d{0.8, 0.6, 0.2}, Metal<>{0.3}}, {"glass", {}, Dielectric<>{1.4}}}; }
  ObjectPath set(int object, int type) { return set_surface_type(scene, {object}, type, memory); }
  int type(int object) const { return surface_type(scene, {object}); }
  const Material& material(int object) const { return *material_of(scene, *find_object(scene, {object})); }
  Material& gold() { return scene.materials[0]; }
  Vec3d colour() const { return std::get<Vec3d>(scene.materials[0].colour); }
};

std::vector<std::string> names(const std::vector<Object>& objects) {
  std::vector<std::string> result;
  for (const Object& object : objects) result.push_back(object.name);
  return result;
}

Scene example() {
  return scene_of({ball("a", {0, 0, 0}),
                   ball("shell", {5, 0, 0}, 1, 1),
                   ball("bubble", {5, 0, 0}, -0.5, 1),
                   {"pair", Group{{ball("c", {10, 0, 0}), ball("d", {15, 0, 0})}}, {}},
                   ball("e", {20, 0, 0})});
}

/// In a picture as high as far.
Scene floor_and_box() {
  Scene scene = seen_scene(
      200, 100, {0, 1, 10}, 53.13,
      {solid(Quad<>{{-50, 0, -50}, {100, 0, 0}, {0, 0, 100}}), solid(Box<>{{-1, 0, -1}, {1, 1, 1}}, {RotateY{90}})});
  scene.materials.resize(1);
  return scene;
}

}  // namespace

TEST_CASE("types are listed as the scene file names them; another one keeps the colour as far as it has one") {
  Typed typed;
  CHECK(std::string(surface_types()[metal]) == "metal");
  CHECK(typed.type(0) == metal);
  CHECK(typed.type(2) == dielectric);
  CHECK(typed.type(9) == -1);
  typed.set(0, lambertian);
  CHECK(typed.material(1) == Material{"gold", Vec3d{0.8, 0.6, 0.2}, Lambertian<>{}});  // it is shared
  typed.set(0, light);
  CHECK(typed.colour() == Vec3d{5, 3.75, 1.25});
  typed.set(0, metal);
  CHECK(typed.colour() == Vec3d{0.8, 0.6, 0.2});
  typed.set(0, dielectric);
  CHECK(typed.material(0) == Material{"gold", Material().colour, Dielectric<>{}});
  CHECK_FALSE(check(typed.scene));
}

TEST_CASE("a type that a material had before is as it was, but for its colour if that has stayed or changed since") {
  Typed typed;
  typed.gold().kind = Metal<>{0.8};
  typed.set(0, dielectric);
  std::get<Dielectric<>>(typed.gold().kind).refractive_index = 1.7;
  typed.set(0, medium_within);
  typed.set(0, metal);
  CHECK(typed.gold() == Material{"gold", Vec3d{0.8, 0.6, 0.2}, Metal<>{0.8}});
  typed.set(0, lambertian);
  typed.gold().colour = Vec3d{0.4, 0.2, 0.1};
  typed.set(0, light);
  typed.gold().colour = Vec3d{40, 20, 10};
  typed.set(0, metal);
  CHECK(typed.gold() == Material{"gold", Vec3d{0.8, 0.4, 0.2}, Metal<>{0.8}});
  typed.set(0, light);
  CHECK(typed.colour() == Vec3d{40, 20, 10});
  typed.set(0, dielectric);
  CHECK(std::get<Dielectric<>>(typed.gold().kind).refractive_index == 1.7);
  typed.gold().name = "brass";  // of which nothing is known
  typed.set(0, metal);
  CHECK(typed.gold() == Material{"brass", Vec3d{0.8, 0.8, 0.8}, Metal<>{}});
  CHECK_FALSE(check(typed.scene));
  Typed textured;
  textured.scene.textures.resize(1);
  textured.gold().colour = TextureIndex{0};
  textured.set(0, dielectric);
  textured.scene.textures.clear();
  textured.set(0, lambertian);
  CHECK(textured.colour() == Vec3d{0.8, 0.8, 0.8});  // the texture is not there any more
}

TEST_CASE("fog within a ball is glass with a medium of its very shape, which another type takes out again") {
  Typed typed;
  CHECK(typed.set(1, medium_within) == ObjectPath{1});
  CHECK(typed.type(1) == medium_within);
  CHECK(typed.type(0) == metal);  // it had the same material
  REQUIRE(typed.scene.objects.size() == 5);
  CHECK(std::get<Vec3d>(std::get<Volume>(typed.scene.objects[2].kind).albedo) == Vec3d{0.8, 0.6, 0.2});
  CHECK(linked_objects(typed.scene, {1}) == ObjectPaths{{2}});
  CHECK_FALSE(check(typed.scene));
  typed.set(1, dielectric);
  CHECK(typed.scene.objects.size() == 4);
  CHECK(typed.type(1) == dielectric);
  typed.set(2, medium_within);
  std::swap(typed.scene.objects[2], typed.scene.objects[3]);  // fog that stands before its ball is found
  CHECK(typed.type(3) == medium_within);
  CHECK(typed.set(3, metal) == ObjectPath{2});
  CHECK(typed.type(2) == metal);
}

TEST_CASE("what cannot hold fog says why") {
  Typed typed;
  CHECK(why_not(typed.scene, {0}, medium_within).empty());
  CHECK(why_not(typed.scene, {3}, medium_within) == "a quad has no inside for fog");
  shape(typed.scene).radius = -1;
  CHECK_FALSE(why_not(typed.scene, {0}, medium_within).empty());
  const Scene before = typed.scene;
  typed.set(0, medium_within);
  CHECK(typed.scene == before);
}

TEST_CASE("a lamp's colour times its power is its radiance") {
  const LightColour lamp = light_colour({7, 6.2, 5});
  CHECK(lamp.power == 7);
  CHECK(lamp.colour.x == 1);
  CHECK(light_radiance(lamp) == Vec3d{7, 6.2, 5});
  CHECK(light_radiance({{0.5, 0.25, 0.5}, 10}) == Vec3d{10, 5, 10});
  CHECK(light_radiance({{0, 0, 0}, 3}) == Vec3d{3, 3, 3});
  CHECK(light_colour({0, 0, 0}).power == 0);
}

TEST_CASE("what is in a selected group is not edited twice") {
  CHECK(outermost({{3, 1}, {0}, {3}, {0}}) == ObjectPaths{{0}, {3}});
  CHECK(outermost({{3, 1}, {3, 0}}) == ObjectPaths{{3, 0}, {3, 1}});
  CHECK(outermost({}).empty());
}

TEST_CASE("copies stand behind what they are copies of, with names of their own, in their groups, with companions") {
  Scene scene = example();
  CHECK(duplicate_objects(scene, {{1}, {0}}) == ObjectPaths{{1}, {3}, {5}});
  CHECK(names(scene.objects) ==
        std::vector<std::string>{"a", "a 2", "shell", "shell 2", "bubble", "bubble 2", "pair", "e"});
  CHECK(scene.objects[3].kind == scene.objects[2].kind);
  Scene grouped = example();
  CHECK(duplicate_objects(grouped, {{3, 0}, {4}}) == ObjectPaths{{3, 1}, {5}});
  CHECK(names(std::get<Group>(grouped.objects[3].kind).objects) == std::vector<std::string>{"c", "c 2", "d"});
}

TEST_CASE("free names count on") {
  Scene scene = example();
  CHECK(free_name(scene, "new") == "new");
  CHECK(free_name(scene, "c") == "c 2");
  scene.objects[0].name = "c 2";
  CHECK(free_name(scene, "c 2") == "c 3");
  CHECK(free_name(scene, "c") == "c 3");
}

TEST_CASE("deleting takes companions along, and materials that only the window has made") {
  Scene scene = example();
  CHECK(delete_objects(scene, {{1}}, {scene.materials[0]}) == 2);
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
    CHECK_FALSE(check(scene));
    CHECK(read_scene(write_scene(scene), "added", ".") == scene);
    if (std::string(what.name) == "a hollow ball") CHECK(linked_objects(scene, added[0]) == ObjectPaths{added[1]});
  }
}

TEST_CASE("a ball stands on the spot, by numbers that print short, and leaves a material of the usual name alone") {
  Scene scene = floor_and_box();
  addition_named("a sphere").add(scene, {{0.123456, 0.0000001, 0.3}, {0, 1, 0}, 0.5});
  CHECK(shape(scene, 2) == Sphere<>{{0.123, 0.25, 0.3}, 0.25, {}});
  CHECK(scene.objects.back().name == "ball");
  CHECK(scene.materials.back().name == "matt");
  addition_named("a sphere").add(scene, {{1, 0, 0}, {0, 1, 0}, 0.5});
  CHECK(scene.objects.back().name == "ball 2");
  CHECK(scene.materials.size() == 2);  // both have the same material
  scene.materials[1].colour = Vec3d{1, 0, 0};
  addition_named("a box").add(scene, {});
  CHECK(scene.materials.size() == 3);
  CHECK(scene.materials.back().name == "matt 2");
}

TEST_CASE("a spot is on the side of the surface that is seen, and as large as suits the distance") {
  const Scene scene = floor_and_box();
  CHECK(normal_at(scene, {0}, {3, 0, 3}) == Vec3d{0, 1, 0});
  CHECK(length(normal_at(scene, {1}, {0, 0.5, 1}) - Vec3d{0, 0, 1}) < 1e-12);
  CHECK(length(normal_at(scene, {1}, {0.2, 1, 0.2}) - Vec3d{0, 1, 0}) < 1e-12);
  const Spot on_floor = spot_at(scene, {0.5, 0.6}, {0}, {0, 0, 0});
  CHECK(on_floor.size == doctest::Approx(1));  // at most a fifth of 10, as a round number: 2 is just too much
  CHECK(on_floor.point == Vec3d{0, 0, 0});
  CHECK(length(spot_at(scene, {0.5, 0.5}, {}, {}).point - Vec3d{0, 1, 0}) < 1e-9);  // in the air
}

}  // namespace tyndall::test::edits_test
