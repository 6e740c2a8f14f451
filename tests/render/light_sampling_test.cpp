#include "tests/support/probe.h"

#include <doctest/doctest.h>

/// Light sampling gives the same light as paths that meet lights by chance, and as closed formulas.
namespace tyndall::test::light_sampling_test {

namespace {

constexpr Integrator all_integrators[] = {Integrator::path, Integrator::nee, Integrator::mis};

/// A matt floor of albedo 0.5 at y = 0, seen straight down where it meets the y axis; one scattering only.
Scene floor_room(Vec3d seen = {0, 0, 0}) {
  Scene scene = dark_room();
  scene.render.max_depth = 1;
  add(scene, Quad<>{{-3000, 0, -3000}, {6000, 0, 0}, {0, 0, 6000}}, lambertian(0.5));
  aim(scene, seen + Vec3d{0.3, 0.4, 0}, seen);
  return scene;
}

Estimate measure(Scene scene, Integrator integrator, SamplerKind sampler, int spp) {
  scene.render.integrator = integrator;
  scene.render.sampler = sampler;
  return radiance(scene, spp);
}

}  // namespace

TEST_CASE("a screen before a rectangular light hides half of it or all of it, also where walls bound the scene") {
  ZScores z;
  for (const Integrator integrator : all_integrators)
    for (const bool walled : {false, true}) {
      Scene scene = floor_room();
      aim(scene, {0.04, 0.05, 0.03}, {0, 0, 0});
      add(scene, Quad<>{{-0.5, 1, -0.5}, {1, 0, 0}, {0, 0, 1}}, lamp(1));
      if (walled) add(scene, Quad<>{{-3000, 9, -3000}, {6000, 0, 0}, {0, 0, 6000}}, lambertian(0));
      Scene half = scene;
      add(half, Quad<>{{-5, 0.5, -5}, {5, 0, 0}, {0, 0, 10}}, lambertian(0));
      const int spp = integrator == Integrator::path ? 4096 : 256;
      z.add("half", measure(half, integrator, SamplerKind::random, spp), 0.25 * 0.7522747 / pi, 4e-2);
      add(scene, Quad<>{{-5, 0.5, -5}, {10, 0, 0}, {0, 0, 10}}, lambertian(0));
      CHECK(measure(scene, integrator, SamplerKind::random, 64).mean == 0);
    }
}

TEST_CASE("all integrators and samplers agree: matt, fuzzy metal, glass, fog, four kinds of lights") {
  Scene scene = dark_room();
  scene.width = scene.height = 48;
  scene.camera = {.look_from = {0, 2, 9}, .look_at = {0, 1, 0}, .vfov = 40, .shutter_close = 1};
  scene.render.max_depth = 8;
  add(scene, Quad<>{{-6, 0, -6}, {12, 0, 0}, {0, 0, 12}}, lambertian(0.7));
  add(scene, sphere({-1.5, 0.7, 0}, 0.7), metal(0.9, 0.3));
  add(scene, sphere({1.5, 0.7, 1}, 0.7), glass(1.5));
  add(scene, sphere({0, 0.5, -1}, 0.5), metal(0.8, 1.0));
  add(scene, Quad<>{{-1, 3, -1}, {2, 0, 0}, {0, 0, 2}}, lamp(2));
  add(scene, Quad<>{{-4, 0.5, -2}, {0.2, 1.5, 0}, {0, 1.5, 0.8}}, lamp(3));
  add(scene, sphere({3, 2, -1}, 0.5), lamp(4));
  add(scene, Sphere<>{{-3, 2, 1}, 0.4, Vec3d{-2, 2.5, 1}}, lamp(3));
  add(scene, Box<>{{2.2, 0, 2}, {2.8, 0.6, 2.6}}, lamp(1), {RotateY{20}});
  add_medium(scene, Box<>{{-0.5, 0.1, 1}, {1, 1.5, 2.5}}, {1.2, 0.4}, 0.9, {RotateY{15}});
  add_medium(scene, Sphere<>{{0, 3, 0}, 1.5, {}}, {0.5, 0}, 0.8);
  const auto mean_of = [&](Integrator integrator, SamplerKind sampler) {
    scene.render.integrator = integrator;
    scene.render.sampler = sampler;
    return picture_mean(film_of(scene, integrator == Integrator::path ? 4096 : 512));
  };
  const Estimate reference = mean_of(Integrator::path, SamplerKind::random);
  for (const Integrator integrator : all_integrators)
    for (const SamplerKind sampler : {SamplerKind::random, SamplerKind::sobol}) {
      const Estimate e = mean_of(integrator, sampler);
      CAPTURE(static_cast<int>(integrator));
      CAPTURE(static_cast<int>(sampler));
      CHECK(std::hypot(e.error, reference.error) < 2e-3 * reference.mean);
      check_agree(e, reference);
    }
}

TEST_CASE("a thousand small lights, and a light around the eye") {
  Scene scene = floor_room();
  for (int i = 0; i < 1000; ++i) add(scene, sphere({0.1 * (i % 40) - 2, 1 + 0.1 * (i / 40), 0.5}, 0.02), lamp(5));
  ZScores z;
  const Estimate path = measure(scene, Integrator::path, SamplerKind::random, 4000);
  const Estimate mis = measure(scene, Integrator::mis, SamplerKind::sobol, 400);
  CHECK(std::hypot(path.error, mis.error) < 0.02 * path.mean);
  check_agree(path, mis);
  Scene inside = floor_room();
  add(inside, sphere({0, 1, 0}, 50), lamp(1));  // the floor within it sees it everywhere above: E = π
  z.add("inside", measure(inside, Integrator::mis, SamplerKind::random, 512), 0.5, 3e-3);
  z.add("inside", measure(inside, Integrator::nee, SamplerKind::random, 512), 0.5, 3e-3);
}

TEST_CASE("light sampling without weights: no sample is out of a film's range, and the mean is right") {
  // Media with a sharp forward peak under 16 lights and a bright sphere around it all: samples of thousands of times
  // the brightest light's radiance are rare, and a fifth of the mean.
  Scene scene = white_room();
  scene.width = scene.height = 24;
  scene.background = Vec3d{0, 0, 0};
  scene.camera = {.look_from = {0, 0, 6}, .look_at = {0, 0, 0}, .vfov = 40};
  scene.render.max_depth = 3;
  for (int i = 0; i < 16; ++i) add(scene, sphere({i % 4 - 1.5, i / 4 - 1.5, 0}, 0.2), lamp(4));
  add(scene, sphere({0, 0, 0}, 30), lamp(0.1));
  add_medium(scene, sphere({0, 0, 0}, 4), {0.3, 0.95}, 0.9);
  const auto mean_of = [&](Integrator integrator, int spp) {
    scene.render.integrator = integrator;
    return picture_mean(film_of(scene, spp));
  };
  const Estimate weighted = mean_of(Integrator::mis, 256), plain = mean_of(Integrator::nee, 4096);
  CHECK(plain.error < 0.1 * weighted.mean);
  CHECK(std::abs(plain.mean - weighted.mean) < 4 * plain.error);
}

}  // namespace tyndall::test::light_sampling_test
