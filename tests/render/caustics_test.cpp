#include "core/accuracy/estimate.h"
#include "core/compile/compile.h"
#include "core/render/prepare.h"
#include "core/scene/load.h"
#include "tests/support/prepared.h"

#include <doctest/doctest.h>

#include <cmath>

/// What is told of light that comes rarely: its chance, found from the scene, and rare bright paths, found from films.
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

namespace {

bool is_rare(Scene scene, std::uint32_t spp) {
  scene.width = 80, scene.height = 60;
  const auto prepared = prepare(scene);
  const Film film = render(*prepared, {.spp = spp}).film;
  return has_rare_bright_paths(estimate_error(film), spp, prepared->caustic_chance());
}

/// A glass sphere under a light whose light only chance finds. The light has the same power at every radius.
Scene caustic(double radius) {
  Scene scene;
  scene.render.caustics = Caustics::scatter;
  scene.camera = {.look_from = {0, 3, 6}, .look_at = {0, 0.6, 0}, .vfov = 40};
  scene.background = Vec3d{0.02, 0.02, 0.02};
  const double radiance = 1.8 / (radius * radius);
  scene.materials = {{"floor", Vec3d{0.7, 0.7, 0.7}, Lambertian<>{}},
                     {"glass", Vec3d{1, 1, 1}, Dielectric<>{1.5}},
                     {"lamp", Vec3d{radiance, radiance, radiance}, Light<>{}}};
  scene.objects = {{"", Solid3d{Quad<>{{-5, 0, -5}, {10, 0, 0}, {0, 0, 10}}, 0}, {}},
                   {"", Solid3d{Sphere<>{{0, 1, 0}, 1, {}}, 1}, {}},
                   {"", Solid3d{Sphere<>{{1, 4, 1}, radius, {}}, 2}, {}}};
  return scene;
}

}  // namespace

TEST_CASE("rare bright paths: a small light through glass is told, before and after the first path has met it") {
  for (const std::uint32_t spp : {16u, 64u, 512u}) CHECK(is_rare(caustic(0.03), spp));
  CHECK(is_rare(caustic(0.3), 16));
  CHECK_FALSE(is_rare(caustic(1.5), 64));
}

TEST_CASE("rare bright paths: pictures that converge are not suspected") {
  for (const char* name : {"cornell-box", "cornell-smoke", "cover", "simple-light", "showroom", "hollow-glass"}) {
    CAPTURE(std::string(name));
    for (const std::uint32_t spp : {4u, 64u}) CHECK_FALSE(is_rare(load_scene(name).scene, spp));
  }
  CHECK(is_rare(load_scene("stress-light-and-fuzz").scene, 64));
}

TEST_CASE("rare bright paths: light off metal with a little fuzz is guided; where it is left to chance, that is told") {
  Scene scene = load_scene("stress-small-fuzz").scene;
  CHECK(prepare(scene)->caustic_chance() == 1);
  for (scene.render.seed = 0; scene.render.seed < 4; ++scene.render.seed) {
    Scene small = scene;
    small.width = 128, small.height = 96;
    const auto prepared = prepare(small);
    const RenderResult result = render(*prepared, {.spp = 64});
    const ErrorEstimate estimate = estimate_error(*prepared, result.kernels, result.film);
    CHECK_FALSE(has_rare_bright_paths(estimate, 64, prepared->caustic_chance()));
  }
  scene.render.caustics = Caustics::scatter;
  CHECK(prepare(scene)->caustic_chance() < 1e-4);
  for (const std::uint32_t spp : {4u, 64u, 256u}) CHECK(is_rare(scene, spp));
}

TEST_CASE("rare bright paths: told from the second sample on, when there is an estimate") {
  CHECK_FALSE(is_rare(caustic(0.03), 1));
  for (const std::uint32_t spp : {2u, 4u, 7u}) CHECK(is_rare(caustic(0.03), spp));
}

TEST_CASE("rare bright paths: a light within glass is told, hollow or solid, in the middle or beside it") {
  for (const bool hollow : {false, true})
    for (const double beside : {0.0, 0.2}) {
      CAPTURE(hollow);
      CAPTURE(beside);
      Scene scene = caustic(0.05);
      scene.objects[1].kind = Solid3d{Sphere<>{{0, 1, 0}, 0.5, {}}, 1};
      scene.objects[2].kind = Solid3d{Sphere<>{{beside, 1, 0}, 0.05, {}}, 2};
      if (hollow) scene.objects.push_back({"", Solid3d{Sphere<>{{0, 1, 0}, -0.4, {}}, 1}, {}});
      for (const std::uint32_t spp : {4u, 64u}) CHECK(is_rare(scene, spp));
    }
}

TEST_CASE("rare bright paths: metal of a little fuzz is told like a mirror, metal of more is not") {
  Scene scene = caustic(0.03);
  for (const double fuzz : {0.0005, 0.01}) {
    CAPTURE(fuzz);
    scene.materials[1].kind = Metal<>{fuzz};
    for (const std::uint32_t spp : {4u, 64u, 512u}) CHECK(is_rare(scene, spp));
  }
  scene.materials[1].kind = Metal<>{0.3};
  CHECK_FALSE(is_rare(scene, 256));
}

}  // namespace tyndall::test::caustics_test
