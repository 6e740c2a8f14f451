#pragma once
#include "app/report/film_difference.h"
#include "core/render/render.h"
#include "core/scene/load.h"

#include <cmath>
#include <string>
#include <vector>

/// Two pictures of a sweep many times over: how well their difference is known, and is said to be known.
namespace tyndall::test {

/// A step in a built-in scene.
struct SweepStep {
  const char *scene, *pointer, *from, *to;
  int width, height;
};

inline Film film_of(const SweepStep& step, const char* value, std::uint32_t seed, std::uint32_t spp) {
  Scene scene = load_scene(step.scene, {{step.pointer, value}}).scene;
  scene.width = step.width, scene.height = step.height, scene.render.seed = seed, scene.render.adaptive = false;
  return render(*prepare(scene), {.threads = 1, .spp = spp}).film;
}

/// Mean square over pixels and channels of the difference of two pictures less the true one.
inline double squared_error(const Film& a, const Film& b, const std::vector<float>& truth) {
  const std::vector<float> x = resolve(a), y = resolve(b);
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += std::pow(static_cast<double>(y[i] - x[i] - truth[i]), 2);
  return sum / static_cast<double>(x.size());
}

struct SweepErrors {
  double gain = 0;        ///< of one seed for both over two, in rms error of a pixel's difference
  double ratio = 0;       ///< the stated error over the true one
  double deviations = 0;  ///< mean square of the mean's error over the stated one
};

/// Differences at 16 samples from so many pairs of pictures, measured against one at `true_spp`.
inline SweepErrors errors_of(const SweepStep& step, std::uint32_t pairs, std::uint32_t true_spp) {
  const Film true_from = film_of(step, step.from, 1000, true_spp), true_to = film_of(step, step.to, 1000, true_spp);
  const FilmDifference exact = film_difference(true_to, true_from);
  std::vector<float> truth = resolve(true_to);
  const std::vector<float> from = resolve(true_from);
  for (std::size_t i = 0; i < truth.size(); ++i) truth[i] -= from[i];
  double one_seed = 0, two_seeds = 0, stated = 0, deviations = 0;
  for (std::uint32_t seed = 0; seed < pairs; ++seed) {
    const Film a = film_of(step, step.from, seed, 16), b = film_of(step, step.to, seed, 16);
    const FilmDifference difference = film_difference(b, a);
    one_seed += squared_error(a, b, truth);
    two_seeds += squared_error(a, film_of(step, step.to, seed + 500, 16), truth);
    stated += std::pow(difference.rms_error, 2);
    deviations += std::pow((difference.mean - exact.mean) / difference.mean_error, 2);
  }
  return {std::sqrt(two_seeds / one_seed), std::sqrt(stated / one_seed), deviations / pairs};
}

}  // namespace tyndall::test
