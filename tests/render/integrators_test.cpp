#include "tests/support/probe.h"
#include "tests/support/skies.h"
#include "tests/support/thorough.h"

#include <doctest/doctest.h>

/// Light sampling gives the same light as paths that meet lights by chance, also where densities are zero or infinite,
/// or where several lights share them: mirrors, glass, shapes that touch, lights that overlap, skies.
namespace tyndall::test::integrators_test {

namespace {

/// A matt floor and a camera that looks down on it.
Scene room() {
  Scene scene = dark_room();
  scene.camera = {.look_from = {0, 2, 6}, .look_at = {0, 0.5, 0}, .vfov = 40};
  scene.render.max_depth = 6;
  add(scene, Quad<>{{-4, 0, -4}, {8, 0, 0}, {0, 0, 8}}, lambertian(0.7));
  return scene;
}

/// A mirror's direction has no density. If it were weighed as if it had one, light would be lost or counted twice.
Scene by_mirror(double fuzz) {
  Scene scene = room();
  scene.materials[0] = metal(0.9, fuzz);
  add(scene, Quad<>{{-3, 0, -3}, {6, 0, 0}, {0, 3, 0}}, lambertian(0.6));
  add(scene, Quad<>{{-1, 3, -1}, {2, 0, 0}, {0, 0, 2}}, lamp(3));
  add(scene, sphere({1, 1, 1}, 0.6), lamp(2));
  return scene;
}

Scene crossing_lamps() {
  Scene scene = room();
  add(scene, sphere({-1, 1.2, 0}, 0.7), lamp(2));
  add(scene, sphere({-0.4, 1.2, 0}, 0.7), lamp(3));  // reaches into the first
  add(scene, sphere({-1, 1.2, 0}, 0.3), lamp(50));   // hidden within it
  add(scene, Quad<>{{0.5, 0.5, -1}, {1.5, 0, 0}, {0, 1.5, 0}}, lamp(2));
  add(scene, Quad<>{{1, 0.5, -1.5}, {0, 0, 1.5}, {0, 1.5, 0}}, lamp(4));  // crosses it
  add(scene, Box<>{{2, 0, 0}, {3, 1, 1}}, lamp(1));
  add(scene, Box<>{{2.5, 0, 0.5}, {3.5, 1, 1.5}}, lamp(2));
  return scene;
}

/// Two lamps in exactly one place, which count as the first of them.
Scene equal_lamps(double second) {
  Scene scene = room();
  for (const double radiance : {3.0, second}) add(scene, Quad<>{{-1, 2, -1}, {2, 0, 0}, {0, 0, 2}}, lamp(radiance));
  return scene;
}

/// A floor with balls of fuzzy metal and glass, and fog.
Scene shelf(const Background& background) {
  Scene scene = white_room();
  scene.background = background;
  scene.camera = {.look_from = {0, 2, 9}, .look_at = {0, 1, 0}, .vfov = 40, .shutter_close = 1};
  scene.render.max_depth = 8;
  add(scene, Quad<>{{-6, 0, -6}, {12, 0, 0}, {0, 0, 12}}, lambertian(0.7));
  add(scene, sphere({-1.5, 0.7, 0}, 0.7), metal(0.9, 0.3));
  add(scene, sphere({1.5, 0.7, 1}, 0.7), glass(1.5));
  add_medium(scene, Box<>{{-0.5, 0.1, 1}, {1, 1.5, 2.5}}, {1.2, 0.4}, 0.9, {RotateY{15}});
  return scene;
}

Scene all_lamps() {
  Scene scene = shelf(Vec3d{0, 0, 0});
  scene.width = scene.height = 48;
  add(scene, sphere({0, 0.5, -1}, 0.5), metal(0.8, 1.0));
  add(scene, Quad<>{{-1, 3, -1}, {2, 0, 0}, {0, 0, 2}}, lamp(2));
  add(scene, Quad<>{{-4, 0.5, -2}, {0.2, 1.5, 0}, {0, 1.5, 0.8}}, lamp(3));
  add(scene, sphere({3, 2, -1}, 0.5), lamp(4));
  add(scene, Sphere<>{{-3, 2, 1}, 0.4, Vec3d{-2, 2.5, 1}}, lamp(3));
  add(scene, Box<>{{2.2, 0, 2}, {2.8, 0.6, 2.6}}, lamp(1), {RotateY{20}});
  add_medium(scene, Sphere<>{{0, 3, 0}, 1.5, {}}, {0.5, 0}, 0.8);
  return scene;
}

Scene under_sky(int lamps) {
  Scene scene = shelf(random_sky(12, 6, 7));
  for (int k = 0; k < lamps; ++k) add(scene, sphere({3 - 0.3 * k, 2, -1}, 0.14), lamp(4));
  add_medium(scene, Sphere<>{{0, 3, 0}, 1.5, {}}, {0.5, 0}, 0);
  return scene;
}

/// The point of a floor, under a thousand lamps.
Scene many_lamps() {
  Scene scene = dark_room();
  scene.render.max_depth = 1;
  add(scene, Quad<>{{-3000, 0, -3000}, {6000, 0, 0}, {0, 0, 6000}}, lambertian(0.5));
  for (int i = 0; i < 1000; ++i) add(scene, sphere({0.1 * (i % 40) - 2, 1 + 0.1 * (i / 40), 0.5}, 0.02), lamp(5));
  aim(scene, {0.3, 0.4, 0}, {0, 0, 0});
  return scene;
}

}  // namespace

TEST_CASE("lights: the same light by every integrator and sampler") {
  struct Row {
    std::string name;
    Scene scene;
    double precision = 5e-3;  ///< standard errors, as a fraction of the mean
    int by_chance = 4096, spp = 512;
  };
  const Row rows[] = {{"all kinds of lamps", all_lamps(), 2e-3},
                      {"beside a hardly blurred mirror", by_mirror(5e-4)},
                      {"beside a mirror", by_mirror(0)},
                      {"lamps that overlap, contain each other and cross", crossing_lamps()},
                      {"a darker lamp first", equal_lamps(9)},
                      {"a sky and 20 lamps", under_sky(20), 0.015, 2048},
                      {"a thousand lamps", many_lamps(), 0.02},
                      {"a sky", under_sky(0), 0.015, 2048},
                      {"equal lamps", equal_lamps(3)},
                      {"a sky and a lamp", under_sky(1), 0.015, 2048},
                      {"beside a blurred mirror", by_mirror(2e-3)},
                      {"beside a very blurred mirror", by_mirror(0.05)}};
  for (const Row& row : tried(rows, 8)) {
    CAPTURE(row.name);
    const auto mean_of = [&](Integrator integrator, SamplerKind sampler) {
      Scene scene = row.scene;
      scene.render.integrator = integrator, scene.render.sampler = sampler;
      return picture_mean(film_of(scene, integrator == Integrator::path ? row.by_chance : row.spp));
    };
    const Estimate chance = mean_of(Integrator::path, SamplerKind::random);
    for (const Integrator integrator : {Integrator::nee, Integrator::mis})
      for (const SamplerKind sampler : {SamplerKind::random, SamplerKind::sobol}) {
        CAPTURE(static_cast<int>(integrator));
        CAPTURE(static_cast<int>(sampler));
        const Estimate e = mean_of(integrator, sampler);
        CHECK(std::hypot(e.error, chance.error) < row.precision * chance.mean);
        check_agree(e, chance);
      }
  }
}

TEST_CASE("lights: a screen before a rectangular one hides half of it or all of it, also where walls bound the scene") {
  ZScores z;
  for (const Integrator integrator : {Integrator::path, Integrator::nee, Integrator::mis})
    for (const bool walled : {false, true}) {
      Scene scene = dark_room();
      scene.render.max_depth = 1;
      scene.render.integrator = integrator;
      add(scene, Quad<>{{-3000, 0, -3000}, {6000, 0, 0}, {0, 0, 6000}}, lambertian(0.5));
      aim(scene, {0.04, 0.05, 0.03}, {0, 0, 0});
      add(scene, Quad<>{{-0.5, 1, -0.5}, {1, 0, 0}, {0, 0, 1}}, lamp(1));
      if (walled) add(scene, Quad<>{{-3000, 9, -3000}, {6000, 0, 0}, {0, 0, 6000}}, lambertian(0));
      Scene half = scene;
      add(half, Quad<>{{-5, 0.5, -5}, {5, 0, 0}, {0, 0, 10}}, lambertian(0));
      z.add("half", radiance(half, integrator == Integrator::path ? 4096 : 256), 0.25 * 0.7522747 / pi, 4e-2);
      add(scene, Quad<>{{-5, 0.5, -5}, {10, 0, 0}, {0, 0, 10}}, lambertian(0));
      CHECK(radiance(scene, 64).mean == 0);
    }
}

TEST_CASE("lights: without weights no sample is out of a film's range, and the mean is right") {
  // Media with a sharp forward peak under 16 lights and a bright sphere around it all: samples of thousands of times
  // the brightest light's radiance are rare, and a fifth of the mean.
  Scene scene = dark_room();
  scene.width = scene.height = 24;
  scene.camera = {.look_from = {0, 0, 6}, .look_at = {0, 0, 0}, .vfov = 40};
  scene.render.max_depth = 3;
  for (int i = 0; i < 16; ++i) add(scene, sphere({i % 4 - 1.5, i / 4 - 1.5, 0}, 0.2), lamp(4));
  add(scene, sphere({0, 0, 0}, 30), lamp(0.1));
  add_medium(scene, sphere({0, 0, 0}, 4), {0.3, 0.95}, 0.9);
  scene.render.integrator = Integrator::mis;
  const Estimate weighted = picture_mean(film_of(scene, 256));
  scene.render.integrator = Integrator::nee;
  const Estimate plain = picture_mean(film_of(scene, 4096));
  CHECK(plain.error < 0.1 * weighted.mean);
  CHECK(std::abs(plain.mean - weighted.mean) < 4 * plain.error);
}

TEST_CASE("skies: fuzzy metal is as bright under a sky of one radiance as in a room of it, by every integrator") {
  for (const Integrator integrator : {Integrator::path, Integrator::nee, Integrator::mis}) {
    Scene scene = white_room(), plain;
    scene.render.integrator = integrator;
    add(scene, sphere({0, 0, 0}, 1), metal(0.8, 0.3));
    aim(scene, {0.4, 0, 5}, {0.4, 0, 0});
    plain = scene;
    scene.background = uniform_sky(8, 4, 0.5);
    plain.background = Vec3d{0.5, 0.5, 0.5};
    const Estimate a = radiance(scene, 1024), b = radiance(plain, 1024);
    CHECK(std::abs(a.mean - b.mean) <= 4 * std::hypot(a.error, b.error) + 1e-5);
  }
}

TEST_CASE("skies: no light comes into a closed room") {
  for (const Integrator integrator : {Integrator::path, Integrator::nee, Integrator::mis}) {
    Scene scene = white_room();
    scene.background = uniform_sky(4, 2, 1);
    scene.render.integrator = integrator;
    for (const double y : {0.0, 4.0}) add(scene, Quad<>{{-5, y, -5}, {0, 0, 10}, {10, 0, 0}}, lambertian(0.5));
    for (const double x : {-5.0, 5.0}) {
      add(scene, Quad<>{{x, 0, -5}, {0, 4, 0}, {0, 0, 10}}, lambertian(0.5));
      add(scene, Quad<>{{-5, 0, x}, {0, 4, 0}, {10, 0, 0}}, lambertian(0.5));
    }
    aim(scene, {0.3, 0.4, 0}, {0, 0, 0});
    CHECK(radiance(scene, 16).mean == 0);
  }
}

TEST_CASE("skies: a sun of a million times the sky is rendered without losses, also where the camera looks into it") {
  Scene scene = white_room();
  scene.background = sunny_sky(1e6f, 32, 12);
  scene.render.integrator = Integrator::mis;
  scene.camera = {.look_from = {0, 1, 0}, .look_at = {0, 1.4, -1}};
  add(scene, Quad<>{{-50, 0, -50}, {0, 0, 100}, {100, 0, 0}}, lambertian(0.5));
  add(scene, sphere({0, 1, -3}, 0.5), metal(0.9, 0));
  add(scene, sphere({1.5, 1, -3}, 0.5), glass(1.5));
  const Film film = film_of(scene, 64);
  CHECK(totals(film).rejected == 0);
  CHECK(film.quantum >= 1e6);
}

}  // namespace tyndall::test::integrators_test
