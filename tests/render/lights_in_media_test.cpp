#include "core/scene/load.h"
#include "core/trace/flight.h"
#include "tests/support/probe.h"
#include "tests/support/thorough.h"

#include <doctest/doctest.h>

/// Small lights in media, where distances are sampled by angle. That no light is lost is tested in
/// light_in_media_test.cpp.
namespace tyndall::test::lights_in_media_test {

namespace {

/// A light of radius 0.01 in the middle of a sphere of media.
Scene light_in_medium(Medium<> medium) {
  Scene scene = dark_room();
  scene.render.max_depth = 1;
  add(scene, sphere({0, 0, 0}, 0.01), lamp(1e4));
  add_medium(scene, sphere({0, 0, 0}, 2), medium, 0.8);
  return scene;
}

Estimate measure(Scene scene, Integrator integrator, int spp) {
  scene.render.integrator = integrator;
  // Not by radiance(), which refuses paths that max_depth cuts: here they are expected.
  const Film film = film_of(scene, spp);
  CHECK(totals(film).rejected == 0);
  std::vector<double> pixels;
  for (const FilmPixel& pixel : film.pixels) pixels.push_back(static_cast<double>(mean(film, pixel).x));
  return estimate(pixels);
}

}  // namespace

TEST_CASE("lights in media: distances by angle have the stated pdf") {
  const Vec3f across{0, 0.3f, 0}, direction{1, 0, 0};
  for (const float reach : {0.0f, 0.01f, 1.0f})
    for (const float end : {-0.5f, 0.001f, 40.0f}) {
      const Equiangular<float> distances = equiangular(across, reach * reach, direction, -1.0f, end);
      const auto claimed = [&](double t) { return static_cast<double>(pdf(distances, static_cast<float>(t))); };
      CHECK(integrate(claimed, -1, static_cast<double>(end)) == doctest::Approx(1).epsilon(2e-5).scale(0));
      std::vector<double> drawn;
      for (int i = 0; i < 2000; ++i)
        drawn.push_back(static_cast<double>(sample(distances, (static_cast<float>(i) + 0.5f) / 2000)));
      const auto below = [&](double t) { return integrate(claimed, -1, t, 500); };
      CHECK(kolmogorov_smirnov(drawn, below) < 0.05);  // evenly placed, so far below chance
    }
}

TEST_CASE("lights in media: what light sampling alone finds, with far less noise") {
  Scene scene = light_in_medium({0.4, 0.5});
  scene.render.max_depth = 4;
  add(scene, Quad<>{{-3, -1, -3}, {6, 0, 0}, {0, 0, 6}}, lambertian(0.5));
  add(scene, Quad<>{{0.5, 0.3, 0}, {0.1, 0, 0}, {0, 0.05, 0.1}}, lamp(50));
  add_medium(scene, Box<>{{-1, -0.9, -1}, {1, 1, 1}}, {0.3, -0.3}, 0.9, {RotateY{30}});
  add_medium(scene, sphere({0, 0, 0}, 2), {0.1, 0}, 0.5);  // a second medium, as large as the first
  scene.camera.look_from = {0, 0.5, 5};
  scene.camera.look_at = {0.8, 0, 0};  // beside the lights, whose edges would otherwise make most of the noise
  scene.camera.vfov = 4;
  CHECK(compile(scene).near.light.size() == 0);
  scene.render.integrator = Integrator::mis;
  const RenderScene compiled = compile(scene);
  CHECK(compiled.near.light == std::vector<std::int32_t>{0, 1, 0, 1, 0, 1});
  CHECK(compiled.kernel == KernelSet::no_specular_paths);
  // The picture's mean over seeds: pixels differ.
  const auto over_seeds = [&](Integrator integrator, int spp) {
    std::vector<double> means;
    for (scene.render.seed = 0; scene.render.seed < 16; ++scene.render.seed)
      means.push_back(measure(scene, integrator, spp).mean);
    return estimate(means);
  };
  const int spp = thorough() ? 128 : 32;
  const Estimate mis = over_seeds(Integrator::mis, spp), nee = over_seeds(Integrator::nee, 4 * spp);
  CAPTURE(mis.mean);
  CAPTURE(mis.error);
  CAPTURE(nee.mean);
  CAPTURE(nee.error);
  CHECK(std::abs(mis.mean - nee.mean) < 4 * std::hypot(mis.error, nee.error));
  CHECK(mis.error < 0.004 * std::sqrt(128.0 / spp) * mis.mean);
  CHECK(mis.error < 2 * nee.error);  // with equal numbers of samples
}

TEST_CASE("lights in media: sampled by angle only where it pays") {
  CHECK(compile(load_scene("stress-light-in-fog").scene).near.light.size() == 1);
  for (const char* name : {"cornell-smoke", "next-week", "showroom", "stress-dense-fog"})
    CHECK(compile(load_scene(name).scene).near.light.size() == 0);
}

}  // namespace tyndall::test::lights_in_media_test
