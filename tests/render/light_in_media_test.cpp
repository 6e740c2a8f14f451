#include "core/trace/flight.h"
#include "tests/support/pictures.h"
#include "tests/support/probe.h"
#include "tests/support/thorough.h"

#include <doctest/doctest.h>

/// Tiny lights in media, where distances are sampled by angle. Samples that scatter next to them have no upper bound;
/// renderers that clamp samples lose that light.
namespace tyndall::test::light_in_media_test {

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
  Scene scene = dark_room();
  scene.render.max_depth = 4;
  add(scene, sphere({0, 0, 0}, 0.01), lamp(1e4));
  add_medium(scene, sphere({0, 0, 0}, 2), {0.4, 0.5}, 0.8);
  add(scene, Quad<>{{-3, -1, -3}, {6, 0, 0}, {0, 0, 6}}, lambertian(0.5));
  add(scene, Quad<>{{0.5, 0.3, 0}, {0.1, 0, 0}, {0, 0.05, 0.1}}, lamp(50));
  add_medium(scene, Box<>{{-1, -0.9, -1}, {1, 1, 1}}, {0.3, -0.3}, 0.9, {RotateY{30}});
  add_medium(scene, sphere({0, 0, 0}, 2), {0.1, 0}, 0.5);  // a second medium, as large as the first
  // Beside the lights, whose edges would otherwise make most of the noise.
  scene.camera = {.look_from = {0, 0.5, 5}, .look_at = {0.8, 0, 0}, .vfov = 4};
  CHECK(compile(scene).near.light.size() == 0);
  scene.render.integrator = Integrator::mis;
  const RenderScene compiled = compile(scene);
  CHECK(compiled.near.light == std::vector<std::int32_t>{0, 1, 0, 1, 0, 1});
  CHECK(compiled.kernel == KernelSet::no_specular_paths);
  const int spp = thorough() ? 128 : 32;
  const Estimate mis = over_seeds(scene, Integrator::mis, spp), nee = over_seeds(scene, Integrator::nee, 4 * spp);
  check_agree(mis, nee);
  CHECK(mis.error < 0.004 * std::sqrt(128.0 / spp) * mis.mean);
  CHECK(mis.error < 2 * nee.error);  // with equal numbers of samples
}

TEST_CASE("lights in media: sampled by angle only where it pays") {
  CHECK(compile(load_scene("stress-light-in-fog").scene).near.light.size() == 1);
  for (const char* name : {"cornell-smoke", "next-week", "showroom", "stress-dense-fog"})
    CHECK(compile(load_scene(name).scene).near.light.size() == 0);
}

}  // namespace tyndall::test::light_in_media_test
