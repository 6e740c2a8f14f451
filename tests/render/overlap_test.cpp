#include "core/scene/load.h"
#include "tests/support/probe.h"
#include "tests/support/thorough.h"

#include <doctest/doctest.h>

/// Places where densities are zero or infinite, or where several lights share them: mirrors, shapes that touch, lights
/// that overlap.
namespace tyndall::test::overlap_test {

namespace {

/// Mean of a picture by one integrator.
Estimate picture(Scene scene, Integrator integrator, SamplerKind sampler, int spp) {
  scene.render.integrator = integrator;
  scene.render.sampler = sampler;
  return picture_mean(film_of(scene, spp));
}

void check_integrators_agree(const Scene& scene) {
  const Estimate reference = picture(scene, Integrator::path, SamplerKind::random, 4096);
  for (const Integrator integrator : {Integrator::nee, Integrator::mis})
    for (const SamplerKind sampler : {SamplerKind::random, SamplerKind::sobol}) {
      const Estimate e = picture(scene, integrator, sampler, 512);
      CAPTURE(static_cast<int>(integrator));
      CAPTURE(static_cast<int>(sampler));
      CHECK(std::hypot(e.error, reference.error) < 5e-3 * reference.mean);
      check_agree(e, reference);
    }
}

Scene room() {
  Scene scene = dark_room();
  scene.camera = {.look_from = {0, 2, 6}, .look_at = {0, 0.5, 0}, .vfov = 40};
  scene.render.max_depth = 6;
  add(scene, Quad<>{{-4, 0, -4}, {8, 0, 0}, {0, 0, 8}}, lambertian(0.7));
  return scene;
}

}  // namespace

TEST_CASE("lights: behind mirrors, next to hardly blurred ones, by every integrator") {
  // A mirror's direction has no density. If it were weighed as if it had one, light would be lost or counted twice.
  constexpr double fuzzes[] = {5e-4, 0, 2e-3, 0.05};
  for (const double fuzz : tried(fuzzes, 2)) {
    Scene scene = room();
    scene.materials[0] = metal(0.9, fuzz);
    add(scene, Quad<>{{-3, 0, -3}, {6, 0, 0}, {0, 3, 0}}, lambertian(0.6));
    add(scene, Quad<>{{-1, 3, -1}, {2, 0, 0}, {0, 0, 2}}, lamp(3));
    add(scene, sphere({1, 1, 1}, 0.6), lamp(2));
    CAPTURE(fuzz);
    check_integrators_agree(scene);
  }
}

TEST_CASE("lights: that overlap, contain each other and cross, by every integrator") {
  Scene scene = room();
  add(scene, sphere({-1, 1.2, 0}, 0.7), lamp(2));
  add(scene, sphere({-0.4, 1.2, 0}, 0.7), lamp(3));  // reaches into the first
  add(scene, sphere({-1, 1.2, 0}, 0.3), lamp(50));   // hidden within it
  add(scene, Quad<>{{0.5, 0.5, -1}, {1.5, 0, 0}, {0, 1.5, 0}}, lamp(2));
  add(scene, Quad<>{{1, 0.5, -1.5}, {0, 0, 1.5}, {0, 1.5, 0}}, lamp(4));  // crosses it
  add(scene, Box<>{{2, 0, 0}, {3, 1, 1}}, lamp(1));
  add(scene, Box<>{{2.5, 0, 0.5}, {3.5, 1, 1.5}}, lamp(2));
  check_integrators_agree(scene);
}

TEST_CASE("lights: two in exactly one place count as the first of them, by every integrator") {
  for (const double second : {3.0, 9.0}) {
    Scene scene = room();
    add(scene, Quad<>{{-1, 2, -1}, {2, 0, 0}, {0, 0, 2}}, lamp(3));
    add(scene, Quad<>{{-1, 2, -1}, {2, 0, 0}, {0, 0, 2}}, lamp(second));
    CAPTURE(second);
    check_integrators_agree(scene);
  }
}

TEST_CASE("contact: the shadow of a black ball that rests on a plane, down to a twentieth of its radius") {
  // At x radii from the contact, 1 - (1 + x^2)^(-3/2) of the sky is seen. If rays left surfaces by a least distance,
  // light would leak in below the sphere.
  ZScores scores;
  std::uint32_t seed = 0;
  for (const double scale : {1e-3, 1.0, 1e3})
    for (const double x : {0.05, 0.5, 1.0, 2.0, 5.0}) {
      Scene scene = white_room();
      scene.render.seed = ++seed;
      add(scene, Quad<>{{-50 * scale, 0, -50 * scale}, {100 * scale, 0, 0}, {0, 0, 100 * scale}}, lambertian(0.8));
      add(scene, sphere({0, scale, 0}, scale), lambertian(0));
      const Vec3d at{x * scale, 0, 0};
      aim(scene, at + scale * Vec3d{x, 1e-3 * x, 0}, at);
      CAPTURE(scale);
      CAPTURE(x);
      const double expected = 0.8 * (1 - std::pow(1 + x * x, -1.5));
      scores.add("floor", radiance(scene, x < 0.1 ? 4096 : 512), expected, x < 0.1 ? 0.02 : 4e-3);
    }
}

TEST_CASE("tree: with and without it every built-in scene's picture is the same, bit for bit") {
  for (const BuiltIn& built_in : built_in_scenes()) {
    Scene scene = load_scene(built_in.name).scene;
    scene.width = 16, scene.height = 12;
    RenderScene compiled = compile(scene);
    if (compiled.bvh.nodes.empty()) continue;
    const RenderOptions options{.spp = 2};
    const Film film = render(compiled, options).film;
    compiled.bvh = {};
    CAPTURE(built_in.name);
    CHECK(render(compiled, options).film == film);
  }
}

}  // namespace tyndall::test::overlap_test
