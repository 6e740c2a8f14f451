#include "core/transport/path.h"
#include "tests/materials/rough_dielectric.h"
#include "tests/support/directions.h"
#include "tests/support/probe.h"

#include <doctest/doctest.h>

/// The path loop with a list of materials of the test's own, whose last one the program does not know.
namespace tyndall::test::longer_list_slow_test {

namespace {

/// The program's scene with ground glass where its materials are lambertian; otherwise as kernels see it.
struct RoughView : SceneView {
  template <class F>
  using MaterialList = LongerList<F>;
  const float* parameter[2];
};

/// Mean radiance of a probe's rays, by the scalar kernel with the longer list.
Estimate kernel_radiance(const Scene& scene, const RoughDielectric<>& glass, std::uint32_t samples) {
  RenderScene columns = compile(scene);
  Column<std::int32_t>& kind = columns.materials.kind;
  constexpr auto matt = place_in<Lambertian<double>, LongerList<double>>;
  std::replace(kind.begin(), kind.end(), matt, place_in<RoughDielectric<double>, LongerList<double>>);
  const std::vector<float> roughness(kind.size(), static_cast<float>(glass.roughness));
  const std::vector<float> index(kind.size(), static_cast<float>(glass.refractive_index));
  const RoughView view{{columns}, {roughness.data(), index.data()}};
  std::vector<double> batches;
  for (std::uint32_t first = 0; first < samples; first += samples / 64) {
    FilmPixel pixel{};
    TileCounts counts;
    const TileJob job{{0, 0, 1, 1}, 1, 0, first, first + samples / 64};
    AloneSamples samples_of_unit(view, job, {1 / columns.film_quantum, &pixel, nullptr, counts});
    NoRecorder recorder;
    follow_paths<float>(view, samples_of_unit, counts, recorder);
    CHECK(pixel.rejected[0] + pixel.rejected[1] == 0);
    batches.push_back((pixel.sum[0][0].value() + pixel.sum[1][0].value()) * columns.film_quantum / (samples / 64));
  }
  return estimate(batches);
}

/// A large pane that is met at the row's angle: one event, after which paths leave the scene or meet a light.
Scene slab_of(const GroundGlass& row, Vec3d background) {
  Scene scene = white_room();
  scene.width = scene.height = 1;
  scene.background = background;
  const double side = row.leaving ? -1 : 1;
  add(scene, Quad<>{{-50, -50 * side, 0}, {100, 0, 0}, {0, 100 * side, 0}}, lambertian(1));
  const Vec3d down = down_at<double>(row.angle);
  aim(scene, -5.0 * down, {0, 0, 0});
  return scene;
}

}  // namespace

TEST_CASE("materials: what a trait decides follows the list") {
  using Longer = LongerList<double>;
  constexpr auto rough = place_in<RoughDielectric<double>, Longer>, glass = place_in<Dielectric<double>, Longer>;
  CHECK(has_trait<&BsdfTraits::transmissive, Longer>(rough));
  CHECK(has_trait<&BsdfTraits::transmissive, Longer>(glass));
  CHECK_FALSE(has_trait<&BsdfTraits::specular, Longer>(rough));
  CHECK_FALSE(has_trait<&BsdfTraits::transmissive>(rough));  // the program's list does not know it
  CHECK_FALSE(has_trait<&BsdfTraits::transmissive, Longer>(-1));
  CHECK(has_trait<&BsdfTraits::diffuse>(place_in<Lambertian<double>, Longer>));
  CHECK(has_trait<&BsdfTraits::emits>(place_in<Light<double>, Longer>));
  CHECK(has_constant_weights<SceneView>);
  CHECK_FALSE(has_constant_weights<RoughView>);
  CHECK(samples_lights_behind<RoughView>);
  CHECK_FALSE(samples_lights_behind<SceneView>);
}

TEST_CASE("path loop: in a white room a pane of ground glass is as bright as its share of light") {
  ZScores scores;
  for (const GroundGlass& row : ground_glasses)
    scores.add("pane", kernel_radiance(slab_of(row, {1, 1, 1}), {row.roughness}, 1 << 16),
               row.reflected + row.refracted);
}

TEST_CASE("path loop: light that ground glass reflects and refracts, found by scattering and by shadow rays") {
  for (const GroundGlass& row : ground_glasses)
    for (const bool behind : {false, true}) {
      if (row.roughness < 0.4) continue;
      CAPTURE(row.roughness);
      CAPTURE(row.angle);
      CAPTURE(row.leaving);
      CAPTURE(behind);
      Scene scene = slab_of(row, {0, 0, 0});
      const Vec3d to_light = normalize(Vec3d{0.4, 0.3, behind ? -1.0 : 1.0});
      constexpr double distance = 20, radius = 6;
      add(scene, sphere(distance * to_light, radius), lamp(2));
      const CapCells seen(to_light, 1 - std::sqrt(1 - (radius / distance) * (radius / distance)));
      const Incident<double> in = event_of(row, 0);
      const RoughDielectric<double> glass{row.roughness};
      const double expected = 2 * sum(seen.integrate([&](Vec3d l) { return eval(glass, in, l); }));
      ZScores scores;
      for (const Integrator integrator : {Integrator::path, Integrator::mis}) {
        scene.render.integrator = integrator;
        const bool requests = integrator == Integrator::mis;
        scores.add("lamp", kernel_radiance(scene, glass, 1 << 16), expected, requests ? 0.02 : 0.1);
      }
    }
}

TEST_CASE("path loop: shadow rays into a ball of ground glass meet its far side, like the paths that go there") {
  Scene scene = white_room();
  scene.width = scene.height = 1;
  scene.background = Vec3d{0, 0, 0};
  add(scene, sphere({0, 0, 0}, 1), lambertian(1));
  add(scene, sphere({2, 0, -20}, 9), lamp(2));
  aim(scene, {3, 0, 5}, {0.2, 0, 0});
  const Estimate by_scattering = kernel_radiance(scene, {0.3}, 1 << 18);
  scene.render.integrator = Integrator::mis;
  const Estimate with_shadow_rays = kernel_radiance(scene, {0.3}, 1 << 17);
  const double error = std::hypot(by_scattering.error, with_shadow_rays.error);
  CHECK(error < 0.02 * by_scattering.mean);
  CHECK(std::abs(by_scattering.mean - with_shadow_rays.mean) < 4 * error);
}

}  // namespace tyndall::test::longer_list_slow_test
