#include "app/window/edit/material_edits.h"

#include "app/window/edit/arrange.h"
#include "core/base/kinds.h"
#include "core/scene/check.h"

#include <doctest/doctest.h>

namespace tyndall::test::material_edits_test {

namespace {

constexpr int lambertian = 0, metal = 1, dielectric = 2, light = 3, medium_within = 4;

Scene example() {
  Scene scene;
  scene.materials = {{"gold", Vec3d{0.8, 0.6, 0.2}, Metal<>{0.3}}, {"glass", {}, Dielectric<>{1.4}}};
  const auto ball = [](double x, int material) {
    return Object{"b", Solid3d{Sphere<>{{x, 0, 0}, 1, {}}, material}, {}};
  };
  scene.objects = {ball(0, 0), ball(3, 0), ball(6, 1), {"q", Solid3d{Quad<>{}, 1}, {}}};
  return scene;
}
const Material& material(const Scene& scene, const ObjectPath& path) {
  return *material_of(scene, *find_object(scene, path));
}

}  // namespace

TEST_CASE("types are listed as the scene file names them, and each object says its own") {
  CHECK(std::string(surface_types()[metal]) == "metal");
  const Scene scene = example();
  CHECK(surface_type(scene, {0}) == metal);
  CHECK(surface_type(scene, {2}) == dielectric);
  CHECK(surface_type(scene, {9}) == -1);
}

TEST_CASE("another type keeps the colour as far as it has one") {
  MaterialMemory memory;
  Scene scene = example();
  set_surface_type(scene, {0}, lambertian, memory);
  CHECK(material(scene, {1}) == Material{"gold", Vec3d{0.8, 0.6, 0.2}, Lambertian<>{}});  // it is shared
  set_surface_type(scene, {0}, light, memory);
  CHECK(std::get<Vec3d>(material(scene, {0}).colour) == Vec3d{5, 3.75, 1.25});
  set_surface_type(scene, {0}, metal, memory);
  CHECK(std::get<Vec3d>(material(scene, {0}).colour) == Vec3d{0.8, 0.6, 0.2});
  set_surface_type(scene, {0}, dielectric, memory);
  CHECK(material(scene, {0}) == Material{"gold", Material().colour, Dielectric<>{}});
  CHECK_FALSE(check(scene).has_value());
}

TEST_CASE("a type that a material had before is as it was, but for its colour if that has stayed or changed since") {
  MaterialMemory memory;
  Scene scene = example();
  const auto gold = [&]() -> Material& { return scene.materials[0]; };
  gold().kind = Metal<>{0.8};
  set_surface_type(scene, {0}, dielectric, memory);
  std::get<Dielectric<>>(gold().kind).refractive_index = 1.7;
  set_surface_type(scene, {0}, medium_within, memory);
  set_surface_type(scene, {0}, metal, memory);
  CHECK(gold() == Material{"gold", Vec3d{0.8, 0.6, 0.2}, Metal<>{0.8}});
  set_surface_type(scene, {0}, lambertian, memory);
  gold().colour = Vec3d{0.4, 0.2, 0.1};
  set_surface_type(scene, {0}, light, memory);
  gold().colour = Vec3d{40, 20, 10};
  set_surface_type(scene, {0}, metal, memory);
  CHECK(std::get<Metal<>>(gold().kind).fuzz == 0.8);
  CHECK(std::get<Vec3d>(gold().colour) == Vec3d{0.8, 0.4, 0.2});
  set_surface_type(scene, {0}, light, memory);
  CHECK(std::get<Vec3d>(gold().colour) == Vec3d{40, 20, 10});
  set_surface_type(scene, {0}, dielectric, memory);
  CHECK(std::get<Dielectric<>>(gold().kind).refractive_index == 1.7);
  gold().name = "brass";  // of which nothing is known
  set_surface_type(scene, {0}, metal, memory);
  CHECK(gold() == Material{"brass", Vec3d{0.8, 0.8, 0.8}, Metal<>{}});
  CHECK_FALSE(check(scene).has_value());
}

TEST_CASE("a texture that is not there any more is not remembered") {
  MaterialMemory memory;
  Scene scene = example();
  scene.textures.resize(1);
  scene.materials[0].colour = TextureIndex{0};
  set_surface_type(scene, {0}, dielectric, memory);
  scene.textures.clear();
  set_surface_type(scene, {0}, lambertian, memory);
  CHECK(std::get<Vec3d>(scene.materials[0].colour) == Vec3d{0.8, 0.8, 0.8});
}

TEST_CASE("fog within a ball is glass with a medium of its very shape, which another type takes out again") {
  MaterialMemory memory;
  Scene scene = example();
  CHECK(set_surface_type(scene, {1}, medium_within, memory) == ObjectPath{1});
  CHECK(surface_type(scene, {1}) == medium_within);
  CHECK(surface_type(scene, {0}) == metal);  // it had the same material
  REQUIRE(scene.objects.size() == 5);
  const Volume& fog = std::get<Volume>(scene.objects[2].kind);
  CHECK(std::get<Vec3d>(fog.albedo) == Vec3d{0.8, 0.6, 0.2});
  CHECK(linked_objects(scene, {1}) == ObjectPaths{{2}});
  CHECK_FALSE(check(scene).has_value());
  set_surface_type(scene, {1}, dielectric, memory);
  CHECK(scene.objects.size() == 4);
  CHECK(surface_type(scene, {1}) == dielectric);
}

TEST_CASE("fog that stands before its ball is found, and the ball with its new place") {
  MaterialMemory memory;
  Scene scene = example();
  set_surface_type(scene, {2}, medium_within, memory);
  std::swap(scene.objects[2], scene.objects[3]);
  CHECK(surface_type(scene, {3}) == medium_within);
  CHECK(set_surface_type(scene, {3}, metal, memory) == ObjectPath{2});
  CHECK(surface_type(scene, {2}) == metal);
}

TEST_CASE("what cannot hold fog says why") {
  MaterialMemory memory;
  Scene scene = example();
  CHECK(why_not(scene, {0}, medium_within).empty());
  CHECK(why_not(scene, {3}, medium_within) == "a quad has no inside for fog");
  std::get<Sphere<>>(std::get<Solid3d>(scene.objects[0].kind).shape).radius = -1;
  CHECK_FALSE(why_not(scene, {0}, medium_within).empty());
  const Scene before = scene;
  set_surface_type(scene, {0}, medium_within, memory);
  CHECK(scene == before);
}

TEST_CASE("a single user has a copy with a new name; others keep theirs") {
  Scene scene = example();
  make_single_user(scene, {1});
  CHECK(material(scene, {0}).name == "gold");
  CHECK(material(scene, {1}).name == "gold 2");
  CHECK(material(scene, {1}).kind == material(scene, {0}).kind);
  const Scene before = scene;
  make_single_user(scene, {1});
  CHECK(scene == before);
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

TEST_CASE("a background of another kind has the present colours, and its own when it was there before") {
  Background background = Gradient{{1, 1, 1}, {0.5, 0.7, 1}};
  BackgroundMemory memory;
  set_background_kind(background, place_in<Hemispheres, Background>, memory);
  CHECK(background == Background(Hemispheres{{0.5, 0.7, 1}, {1, 1, 1}}));
  set_background_kind(background, place_in<Vec3d, Background>, memory);
  CHECK(background == Background(Vec3d{0.5, 0.7, 1}));
  set_background_kind(background, place_in<Gradient, Background>, memory);
  CHECK(background == Background(Gradient{{1, 1, 1}, {0.5, 0.7, 1}}));
}

}  // namespace tyndall::test::material_edits_test
