#include "core/render/measure.h"

#include "tests/support/probe.h"
#include "tests/support/thorough.h"

#include <doctest/doctest.h>

namespace tyndall::test::measure_test {

namespace {

Measured measure(const Scene& scene, double error) { return measure_mean(scene, {1, "", error}); }

}  // namespace

TEST_CASE("measuring: the samples that planned the measurement are not part of it") {
  Scene scene = medium_sphere();
  const Measured measured = measure(scene, 1e-3);
  CHECK(measured.value.error <= 1e-3);
  const auto spp = static_cast<int>(measured.totals.samples / 256);
  CHECK(spp > 64);
  int found = 0;
  for (scene.render.seed = 1; scene.render.seed < 4; ++scene.render.seed) {
    const FilmMean one = film_mean(film_of(scene, spp));
    found += one.mean == measured.value.mean && one.error == measured.value.error ? 1 : 0;
  }
  CHECK(found == 1);
  CHECK(measure(medium_sphere(), 1e-3).value.mean == measured.value.mean);
}

TEST_CASE("measuring: stops when it is told to") {
  int calls = 0;
  const Measured measured =
      measure_mean(medium_sphere(), {1, "", 1e-6}, [&](const RenderProgress&) { return ++calls < 2; });
  CHECK(measured.interrupted);
  CHECK(measured.totals.samples < 256 * 64);
}

TEST_CASE("measuring: ends early if the mean is clearly not the expected one") {
  const Measured measured = measure_mean(medium_sphere(), {1, "", 1e-7, 0.5});
  CHECK(measured.totals.samples == 256 * 64);
  CHECK(std::abs(z_score(measured.value, 0.5)) > 8);
}

TEST_CASE("measuring: a picture without noise takes no more samples than the pilot") {
  Scene scene = medium_sphere();
  scene.objects.clear();
  const Measured measured = measure(scene, 0);
  CHECK(measured.value.mean == 1);
  CHECK(measured.value.error == 0);
  CHECK(measured.totals.samples == 256 * 64);
}

TEST_CASE("z-scores: in standard errors, with room for the rounding of single precision") {
  CHECK(z_score({1.002, 1e-3}, 1) == doctest::Approx(2).epsilon(1e-5).scale(0));
  CHECK(z_score({0.999, 1e-3}, 1) == doctest::Approx(-1).epsilon(1e-5).scale(0));
  CHECK(z_score({0.8f, 0}, 0.8) < 0.1);
  CHECK(z_score({0.80001, 0}, 0.8) > 4);
  CHECK(z_score({0, 0}, 0) == 0);
  CHECK(std::isinf(z_score({1e-9, 0}, 0)));
}

TEST_CASE("z-scores: the band of their mean square") {
  // With 100 scores: the 3.17e-5 and 1 - 3.17e-5 quantiles of chi-square with 100 degrees of freedom.
  CHECK(mean_square_band(100).low == doctest::Approx(0.5269).epsilon(0.01).scale(0));
  CHECK(mean_square_band(100).high == doctest::Approx(1.6681).epsilon(0.01).scale(0));
  CHECK(mean_square_band(1).low == 0);
  CHECK(mean_square_band(1).high > 16);
}

TEST_CASE(
    "measuring: standard errors say how far measurements lie apart, also where pixels differ and points are even") {
  if (!thorough()) return;
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

}  // namespace tyndall::test::measure_test
