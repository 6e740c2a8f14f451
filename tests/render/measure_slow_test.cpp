#include "core/render/measure.h"

#include "tests/support/probe.h"

#include <doctest/doctest.h>

namespace tyndall::test::measure_slow_test {

namespace {

Measured measure(const Scene& scene, double error) { return measure_mean(scene, {1, "", error}); }

}  // namespace

TEST_CASE(
    "measuring: standard errors say how far measurements lie apart, also where pixels differ and points are even") {
  for (const SamplerKind sampler : {SamplerKind::random, SamplerKind::sobol}) {
    CAPTURE(static_cast<int>(sampler));
    Scene scene = medium_sphere();
    scene.render.sampler = sampler;
    const double truth = measure(scene, 2e-5).value.mean;
    ZScores scores;
    Moments z;
    for (std::uint32_t run = 1; run <= 100; ++run) {
      scene.render.seed = run * max_rounds;
      const FilmMean one = measure(scene, 5e-4).value;
      scores.add("fog ball", {one.mean, one.error}, truth, 5e-4 / truth);
      z.add(z_score(one, truth));
    }
    CHECK(std::abs(z.estimate().mean) <= 4 * z.estimate().error);
  }
}

}  // namespace tyndall::test::measure_slow_test
