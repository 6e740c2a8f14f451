#include "core/render/prepare.h"

#include "core/compile/compile.h"
#include "core/scene/load.h"

#include <doctest/doctest.h>

#include <cmath>

namespace tyndall::test::caustics_test {

namespace {

/// A floor, a glass sphere of radius 1, and a light `distance` above its centre.
Scene sphere_under_light(double radius, double distance) {
  Scene scene;
  scene.render.caustics = Caustics::scatter;
  scene.camera.look_from = {0, 2, 8};
  scene.materials = {{"floor", Vec3d{0.7, 0.7, 0.7}, Lambertian<>{}},
                     {"glass", Vec3d{1, 1, 1}, Dielectric<>{1.5}},
                     {"lamp", Vec3d{9, 9, 9}, Light<>{}}};
  scene.objects = {{"", Solid3d{Quad<>{{-5, -1, -5}, {10, 0, 0}, {0, 0, 10}}, 0}, {}},
                   {"", Solid3d{Sphere<>{{0, 0, 0}, 1, {}}, 1}, {}},
                   {"", Solid3d{Sphere<>{{0, distance, 0}, radius, {}}, 2}, {}}};
  return scene;
}

/// The chance in a scene without a guide.
double chance(const Scene& scene) {
  const Guide none;
  return PreparedScene(std::make_shared<const Scene>(scene), compile(scene), &none).caustic_chance();
}

}  // namespace

TEST_CASE("caustics: the chance is the light's fraction of all directions, seen from the glass") {
  CHECK(chance(sphere_under_light(0.03, 3)) == doctest::Approx(0.5 * (1 - std::sqrt(1 - 1e-4))));
  CHECK(chance(sphere_under_light(1.5, 3)) == doctest::Approx(0.5 * (1 - std::sqrt(0.75))));
  CHECK(chance(sphere_under_light(4, 3)) == 1);  // the light is around the sphere and fills all directions
}

TEST_CASE("caustics: a light within glass is seen from its surface") {
  const auto seen_from_glass = doctest::Approx(0.5 * (1 - std::sqrt(1 - 0.05 * 0.05)));
  CHECK(chance(sphere_under_light(0.05, 0.3)) == seen_from_glass);
  CHECK(chance(sphere_under_light(0.05, 0)) == seen_from_glass);
  Scene scene = sphere_under_light(0.05, 0.3);
  scene.camera.look_from = {0.5, 0, 0};  // the camera is within the glass, too: a room, not a bulb
  CHECK(chance(scene) > 0.005);
  scene = sphere_under_light(0.05, 0.3);
  scene.materials[0].kind = Metal<>{0.5};  // now only a medium can show the light
  CHECK(chance(scene) == 1);
  scene.objects.push_back({"", Volume{Box<>{{4, -1, -1}, {6, 1, 1}}, {}, Medium<>{0.1, 0}, Vec3d{1, 1, 1}}, {}});
  CHECK(chance(scene) == seen_from_glass);
}

TEST_CASE("caustics: the lobe of metal with a little fuzz makes the light larger") {
  Scene scene = sphere_under_light(0.03, 3);
  scene.materials[1].kind = Metal<>{0.01};
  CHECK(chance(scene) == doctest::Approx(0.5 * (1 - std::sqrt(1 - 0.02 * 0.02))));
}

TEST_CASE("caustics: none without something smooth that catches light, or something matt that shows it") {
  Scene scene = sphere_under_light(0.03, 3);
  const double through_glass = chance(scene);
  scene.materials[1].kind = Metal<>{0};
  CHECK(chance(scene) == through_glass);
  scene.materials[1].kind = Metal<>{0.1};  // metal of so much fuzz does not count as smooth
  CHECK(chance(scene) == 1);
  scene = sphere_under_light(0.03, 3);
  scene.materials[0].kind = Metal<>{0.1};
  CHECK(chance(scene) == 1);
  CHECK(chance(sphere_under_light(0.03, 30)) == 1);  // the sphere is too far to catch a hundredth of the light
  CHECK(chance(load_scene("cornell-box").scene) == 1);
}

TEST_CASE("caustics: pairs with specular paths are left out, unless these are switched off") {
  Scene scene = sphere_under_light(0.03, 3);
  CHECK(chance(scene) < 0.001);
  scene.render.caustics = Caustics::chains;
  CHECK(chance(scene) == 1);
  scene.materials[1].kind = Metal<>{0.01};  // specular paths need a perfect mirror
  CHECK(chance(scene) < 0.001);
}

TEST_CASE("caustics: specular paths find light off flat mirrors and through boxes, not quads, of glass") {
  const Material mirror{"", Vec3d{1, 1, 1}, Metal<>{0}}, clear{"", Vec3d{1, 1, 1}, Dielectric<>{1.5}};
  const auto chance_with = [](auto shape, const Material& material) {
    Scene scene = sphere_under_light(0.03, 3);
    scene.materials[1] = material;
    std::get<Solid3d>(scene.objects[1].kind).shape = shape;
    scene.objects.push_back(
        {"", Solid3d{Quad<>{{-5, 5, -5}, {10, 0, 0}, {0, 0, 10}}, 0}, {}});  // for light sent upward
    scene.render.caustics = Caustics::chains;
    return chance(scene);
  };
  CHECK(chance_with(Quad<>{{-1, -0.5, -1}, {2, 0, 0}, {0, 0, 2}}, mirror) == 1);
  CHECK(chance_with(Quad<>{{-1, -0.5, -1}, {2, 0, 0}, {0, 0, 2}}, clear) < 0.001);
  CHECK(chance_with(Box<>{{-1, -0.5, -1}, {1, 0, 1}}, mirror) == 1);
  CHECK(chance_with(Box<>{{-1, -0.5, -1}, {1, 0, 1}}, clear) == 1);
  CHECK(chance(load_scene("stress-pane").scene) == 1);
  const Material water{"", Vec3d{1, 1, 1}, Dielectric<>{1.33}};  // light leaves by all faces
  CHECK(chance_with(Box<>{{-1, -0.5, -1}, {1, 0, 1}}, water) < 0.001);
}

}  // namespace tyndall::test::caustics_test
