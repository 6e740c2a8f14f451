#include "app/report/film_difference.h"

#include "core/render/render.h"
#include "core/scene/load.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

namespace tyndall::test::film_difference_slow_test {
namespace {

/// A sweep's step in a built-in scene.
struct Step {
  const char *scene, *pointer, *from, *to;
  double least_gain;  ///< of one seed over two, in rms error of a pixel's difference
};

Film film_of(const Step& step, const char* value, std::uint32_t seed, std::uint32_t spp) {
  Scene scene = load_scene(step.scene, {{step.pointer, value}}).scene;
  scene.width = 96, scene.height = 54, scene.render.seed = seed, scene.render.adaptive = false;
  RenderOptions options;
  options.spp = spp;
  return render(*prepare(scene), options).film;
}

std::vector<double> difference_of(const Film& a, const Film& b) {
  const std::vector<float> x = resolve(a), y = resolve(b);
  std::vector<double> difference(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) difference[i] = static_cast<double>(y[i]) - static_cast<double>(x[i]);
  return difference;
}

double mean_square(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum / static_cast<double>(a.size());
}

}  // namespace

TEST_CASE("sweep: with one seed differences are cleaner than with two, and their stated error is the true one") {
  for (const Step& step : {Step{"showroom", "/materials/gold/fuzz", "0.18", "0.20", 4},
                           Step{"glass-spheres", "/materials/glass/refractive_index", "1.5", "1.55", 3},
                           Step{"cornell-smoke", "/objects/6/density", "0.01", "0.011", 20},
                           Step{"defocus", "/camera/focus_distance", "3.4", "3.6", 2},
                           Step{"showroom", "/camera/vfov", "34", "35", 1.4}}) {
    const std::vector<double> truth =
        difference_of(film_of(step, step.from, 900, 2048), film_of(step, step.to, 900, 2048));
    double one_seed = 0, two_seeds = 0, stated = 0;
    constexpr std::uint32_t seeds = 20;
    for (std::uint32_t seed = 0; seed < seeds; ++seed) {
      const Film a = film_of(step, step.from, seed, 16), b = film_of(step, step.to, seed, 16);
      one_seed += mean_square(difference_of(a, b), truth);
      two_seeds += mean_square(difference_of(a, film_of(step, step.to, seed + 100, 16)), truth);
      stated += std::pow(film_difference(b, a).rms_error, 2);
    }
    const double gain = std::sqrt(two_seeds / one_seed), ratio = std::sqrt(stated / one_seed);
    MESSAGE(step.scene, " ", step.pointer, ": ", gain, " times cleaner; stated over true ", ratio);
    CHECK(gain >= step.least_gain);
    CHECK(ratio > 0.8);
    CHECK(ratio < 1.25);
  }
}

}  // namespace tyndall::test::film_difference_slow_test
