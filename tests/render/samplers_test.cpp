#include "tests/support/probe.h"

#include <doctest/doctest.h>

/// All pixels of a probe show the same thing, each with random numbers of its own. So the means of 1024 pixels tell a
/// sampler's mean and variance.
namespace tyndall::test::samplers_test {

namespace {

struct Known {
  const char* what;
  Scene scene;
  double expected;
};

std::vector<Known> known() {
  Scene sky = white_room();
  sky.background = Gradient{};
  sky.render.max_depth = 1;
  add(sky, Quad<>{{-100, 0, -100}, {0, 0, 200}, {200, 0, 0}}, lambertian(1));
  aim(sky, {0, 3, 1}, {0, 0, 0});

  Scene light_above = dark_room();
  light_above.render.integrator = Integrator::mis;
  add(light_above, Quad<>{{-0.05, 0, -0.05}, {0, 0, 0.1}, {0.1, 0, 0}}, lambertian(0.8));
  add(light_above, Quad<>{{0, 1, 0}, {1, 0, 0}, {0, 0, 1}}, lamp(1));
  aim(light_above, {0.01, 0.02, 0.005}, {0, 0, 0});

  Scene fog = white_room();
  add_medium(fog, sphere({0, 0, 0}, 1), {1, 0}, 0.9);
  aim(fog, {0.6, 0, 5}, {0.6, 0, 0});

  Scene smoke = white_room();
  add_medium(smoke, sphere({0, 0, 0}, 1), {1, 0}, 0);
  aim(smoke, {0, 0, 5}, {0, 0, 0});

  Scene shutter = white_room();
  add(shutter, Sphere<>{{0, 0, 0}, 0.5, Vec3d{0, 2, 0}}, lambertian(0));
  aim(shutter, {0, 0, 5}, {0, 0.3, 0});
  shutter.camera.shutter_close = 1;

  return {{"matt plane under the sky", sky, 0.5833333333333333},
          {"rectangular lamp", light_above, 0.8 * 0.4352098756835516 / pi},
          {"fog ball", fog, 0.8580551818624801},
          {"smoke ball", smoke, 0.13533528323661267},
          {"moving ball", shutter, 1 - 0.4004495957273638}};
}

}  // namespace

TEST_CASE("samplers: over a thousand randomisations neither is off, and sobol scatters no more than random") {
  ZScores scores;
  for (const Known& k : known())
    for (const int spp : {16, 64}) {
      Scene scene = k.scene;
      scene.render.seed = static_cast<std::uint32_t>(spp);
      scene.render.sampler = SamplerKind::random;
      const Estimate random = radiance(scene, spp);
      scene.render.sampler = SamplerKind::sobol;
      const Estimate sobol = radiance(scene, spp);
      CAPTURE(k.what);
      CAPTURE(spp);
      scores.add("random", random, k.expected, 0.05);
      scores.add("sobol", sobol, k.expected, 0.05);
      CHECK(sobol.error <= 1.05 * random.error);
    }
}

}  // namespace tyndall::test::samplers_test
