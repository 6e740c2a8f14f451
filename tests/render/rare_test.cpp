#include "core/accuracy/estimate.h"

#include "core/scene/load.h"
#include "tests/support/prepared.h"

#include <doctest/doctest.h>

namespace tyndall::test::rare_test {

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

}  // namespace tyndall::test::rare_test
