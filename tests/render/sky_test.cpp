#include "tests/support/probe.h"
#include "tests/support/skies.h"

#include "core/compile/columns.h"
#include "core/trace/sky.h"

#include <doctest/doctest.h>

/// Light from a picture of the sky: the same by all integrators, and as sums over its texels.
namespace tyndall::test::sky_render_test {

namespace {

constexpr Integrator all_integrators[] = {Integrator::path, Integrator::nee, Integrator::mis};

Scene room_under(const SkyPicture& sky) {
  Scene scene = white_room();
  scene.background = sky;
  return scene;
}

/// What a matt plane of albedo 1 that faces up reflects: the sum over directions of radiance times cosine, over pi.
double reflected_by_floor(const SkyPicture& sky) {
  const SkyColumns columns = sky_columns(sky, true, nullptr);
  const SkyView view = view_of(columns);
  constexpr int rows = 2048, across = 4096;
  double sum = 0;
  for (int y = 0; y < rows / 2; ++y)
    for (int x = 0; x < across; ++x) {
      const double theta = pi * (y + 0.5) / rows, phi = 2 * pi * (x + 0.5) / across;
      const Vec3d d{std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)};
      sum += sky_towards<double>(view, d).radiance.x * std::cos(theta) * std::sin(theta);
    }
  return sum * 2 * pi / across / rows;
}

}  // namespace

TEST_CASE("furnace: under a sky of one radiance all things have their albedo, by every integrator") {
  ZScores z;
  for (const Integrator integrator : all_integrators)
    for (const Material& material : {lambertian(0.8), metal(0.8, 0.3), metal(0.8, 0), glass(1.5)}) {
      Scene scene = room_under(uniform_sky(8, 4, 0.5));
      scene.render.integrator = integrator;
      add(scene, sphere({0, 0, 0}, 1), material);
      aim(scene, {0.4, 0, 5}, {0.4, 0, 0});
      const bool mirrors = std::holds_alternative<Metal<>>(material.kind);
      const double fuzz = mirrors ? std::get<Metal<>>(material.kind).fuzz : 0;
      const double expected = std::holds_alternative<Dielectric<>>(material.kind) ? 0.5 : 0.4;
      if (fuzz == 0) z.add("ball", radiance(scene, 1024), expected, 0.01);
      // Fuzzy metal absorbs what ends below its surface: it is as bright as under a plain background.
      Scene plain = scene;
      plain.background = Vec3d{0.5, 0.5, 0.5};
      const Estimate a = radiance(scene, 1024), b = radiance(plain, 1024);
      CHECK(std::abs(a.mean - b.mean) <= 4 * std::hypot(a.error, b.error) + 1e-5);
    }
}

TEST_CASE("a matt floor reflects the sum over the texels of the sky above it") {
  ZScores z;
  SkyPicture sun = sunny_sky(1e6f);
  sun.rotate_y = 33;
  for (const SkyPicture& sky : {random_sky(16, 8, 1), sun}) {
    const double expected = 0.5 * reflected_by_floor(sky);
    for (const Integrator integrator : {Integrator::nee, Integrator::mis})
      for (const SamplerKind sampler : {SamplerKind::random, SamplerKind::sobol}) {
        Scene scene = room_under(sky);
        scene.render.integrator = integrator;
        scene.render.sampler = sampler;
        scene.render.max_depth = 1;
        add(scene, Quad<>{{-3000, 0, -3000}, {0, 0, 6000}, {6000, 0, 0}}, lambertian(0.5));
        aim(scene, {0.3, 0.4, 0}, {0, 0, 0});
        const Film film = film_of(scene, 256);
        CHECK(totals(film).rejected == 0);
        z.add("floor", radiance_of(film), expected, 0.01);
      }
  }
}

TEST_CASE("all integrators agree under a sky: matt, fuzzy metal, glass, fog, absorbing fog, with and without lamps") {
  for (const int lamps : {0, 1, 20}) {
    CAPTURE(lamps);
    Scene scene = room_under(random_sky(12, 6, 7));
    scene.camera = {.look_from = {0, 2, 9}, .look_at = {0, 1, 0}, .vfov = 40};
    scene.render.max_depth = 8;
    add(scene, Quad<>{{-6, 0, -6}, {12, 0, 0}, {0, 0, 12}}, lambertian(0.7));
    add(scene, sphere({-1.5, 0.7, 0}, 0.7), metal(0.9, 0.3));
    add(scene, sphere({1.5, 0.7, 1}, 0.7), glass(1.5));
    for (int k = 0; k < lamps; ++k) add(scene, sphere({3 - 0.3 * k, 2, -1}, 0.14), lamp(4));
    add_medium(scene, Box<>{{-0.5, 0.1, 1}, {1, 1.5, 2.5}}, {1.2, 0.4}, 0.9, {RotateY{15}});
    add_medium(scene, Sphere<>{{0, 3, 0}, 1.5, {}}, {0.5, 0}, 0);
    std::vector<Estimate> found;
    for (const Integrator integrator : all_integrators) {
      scene.render.integrator = integrator;
      found.push_back(picture_mean(film_of(scene, integrator == Integrator::path ? 2048 : 512)));
    }
    for (const Estimate& e : found) {
      CHECK(e.error <= 0.01 * found[0].mean);
      check_agree(e, found[0]);
    }
  }
}

TEST_CASE("no light of the sky comes into a closed room, and half of it past a screen") {
  for (const Integrator integrator : all_integrators) {
    Scene scene = room_under(uniform_sky(4, 2, 1));
    scene.render.integrator = integrator;
    add(scene, Quad<>{{-5, 0, -5}, {0, 0, 10}, {10, 0, 0}}, lambertian(0.5));
    add(scene, Quad<>{{-5, 4, -5}, {0, 0, 10}, {10, 0, 0}}, lambertian(0.5));
    for (const double x : {-5.0, 5.0}) {
      add(scene, Quad<>{{x, 0, -5}, {0, 4, 0}, {0, 0, 10}}, lambertian(0.5));
      add(scene, Quad<>{{-5, 0, x}, {0, 4, 0}, {10, 0, 0}}, lambertian(0.5));
    }
    aim(scene, {0.3, 0.4, 0}, {0, 0, 0});
    CHECK(totals(film_of(scene, 16)).rejected == 0);
    CHECK(radiance(scene, 16).mean == 0);
  }
}

TEST_CASE("a sun of a million times the sky is rendered without losses, also where the camera looks into it") {
  Scene scene = room_under(sunny_sky(1e6f, 32, 12));
  scene.render.integrator = Integrator::mis;
  scene.camera = {.look_from = {0, 1, 0}, .look_at = {0, 1.4, -1}};
  add(scene, Quad<>{{-50, 0, -50}, {0, 0, 100}, {100, 0, 0}}, lambertian(0.5));
  add(scene, sphere({0, 1, -3}, 0.5), metal(0.9, 0));
  add(scene, sphere({1.5, 1, -3}, 0.5), glass(1.5));
  const Film film = film_of(scene, 64);
  CHECK(totals(film).rejected == 0);
  CHECK(film.quantum >= 1e6);
}

}  // namespace tyndall::test::sky_render_test
