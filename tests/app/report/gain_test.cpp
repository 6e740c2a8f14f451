#include "app/report/gain.h"
#include "tests/support/pictures.h"
#include "tests/support/prepared.h"
#include "tests/support/thorough.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

/// What users are told about the kernel and the methods that render their scene: what they gain, or that there is
/// nothing to gain.

namespace tyndall::test::gain_test {

TEST_CASE("kernel gain: nothing is measured where the full kernel renders the scene") {
  const auto box = prepare(load_scene("cornell-box").scene);
  REQUIRE(box->columns().kernel != KernelSet::everything);
  const KernelGain scalar = measure_kernel_gain(*box, *choose_kernels("scalar"));
  CHECK(scalar.isa == "scalar");
  CHECK(scalar.pairs == 0);
  CHECK(scalar.gain == 1);
  CHECK(scalar.same_picture);
  RenderScene full = box->columns();
  full.kernel = KernelSet::everything;
  CHECK(measure_kernel_gain(SceneViewOf(full).prepared(), *choose_kernels("")).pairs == 0);
}

TEST_CASE("kernel gain: a set's own kernel is compared with the full one and gives the same picture") {
  const Kernels best = *choose_kernels("");
  const auto box = prepare(small_scene("cornell-box", 32, 32, 1));
  if (best.set_for(box->view()) == KernelSet::everything) return;  // this processor's widest set has the full one alone
  const KernelGain gain = measure_kernel_gain(*box, best);
  CHECK(gain.isa == best.isa);
  CHECK(gain.pairs > 0);
  CHECK(gain.same_picture);
  CHECK(gain.minimum <= gain.gain);
  CHECK(gain.gain <= gain.maximum);
}

TEST_CASE("method gain: time and error beside doing without; nothing where a scene has no use for the method") {
  struct Case {
    MisMethod method;
    Scene scene;
    double min_time, max_time, max_error;
    const char* without;
  };
  for (const Case& c :
       {Case{MisMethod::specular, small_scene("stress-bulb", 48, 36, 1), 0.5, 20, 0.5, "cornell-box"},
        Case{MisMethod::splitting, small_scene("glass-spheres", 48, 36, 1), 0, 3, 1, "cornell-box"},
        Case{MisMethod::sharing, close_up("cornell-box", 64, 64), 1, 5, 0.8, "cover"}}) {  // the sky lights `cover`
    const MethodGain gain = measure_method_gain(c.method, c.scene, "");
    CHECK(gain.measured);
    CHECK(gain.time > c.min_time);
    CHECK(gain.time < c.max_time);
    CHECK(gain.error < c.max_error);
    CHECK_FALSE(measure_method_gain(c.method, small_scene(c.without, 48, 36, 1), "").measured);
  }
}

namespace {

/// A step in a built-in scene.
struct SweepStep {
  const char *scene, *pointer, *from, *to;
  int width, height;
};

Film film_of(const SweepStep& step, const char* value, std::uint32_t seed, std::uint32_t spp) {
  Scene scene = load_scene(step.scene, {{step.pointer, value}}).scene;
  scene.width = step.width, scene.height = step.height, scene.render.seed = seed, scene.render.adaptive = false;
  return render(*prepare(scene), {.threads = 1, .spp = spp}).film;
}

/// Mean square over pixels and channels of the difference of two pictures less the true one.
double squared_error(const Film& a, const Film& b, const std::vector<float>& truth) {
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
SweepErrors errors_of(const SweepStep& step, std::uint32_t pairs, std::uint32_t true_spp) {
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

constexpr SweepStep gold{"showroom", "/materials/gold/fuzz", "0.18", "0.20", 48, 27};

}  // namespace

TEST_CASE("film difference: its error is that of the difference, far below those of both pictures") {
  const SweepErrors errors = errors_of(gold, 6, 1024);
  CHECK(errors.ratio > 0.8);
  CHECK(errors.ratio < 1.25);
  CHECK(errors.gain > 3);
  CHECK(errors.deviations < 6);
  CHECK(errors.deviations > 0.05);
}

TEST_CASE("film difference: equal films differ by nothing, and one sample states no error") {
  const Film film = film_of(gold, gold.to, 1, 4), single = film_of(gold, gold.to, 1, 1);
  CHECK(film_difference(film, film).rms == 0);
  CHECK(film_difference(film, film).rms_error == 0);
  const FilmDifference noise = film_difference(film_of(gold, gold.to, 1, 16), film_of(gold, gold.to, 2, 16));
  CHECK(noise.rms < noise.rms_error);  // the products of two halves have no bias
  CHECK(std::isinf(film_difference(single, single).rms_error));
}

TEST_CASE("sweep: with one seed differences are cleaner than with two, and their stated error is the true one") {
  if (!thorough()) return;
  for (const auto& [step, least_gain] :
       {std::pair{SweepStep{"showroom", "/materials/gold/fuzz", "0.18", "0.20", 96, 54}, 4.0},
        std::pair{SweepStep{"glass-spheres", "/materials/glass/refractive_index", "1.5", "1.55", 96, 54}, 3.0},
        std::pair{SweepStep{"cornell-smoke", "/objects/6/density", "0.01", "0.011", 96, 54}, 20.0},
        std::pair{SweepStep{"defocus", "/camera/focus_distance", "3.4", "3.6", 96, 54}, 2.0},
        std::pair{SweepStep{"showroom", "/camera/vfov", "34", "35", 96, 54}, 1.4}}) {
    const SweepErrors errors = errors_of(step, 20, 2048);
    MESSAGE(step.scene, " ", step.pointer, ": ", errors.gain, " times cleaner; stated over true ", errors.ratio);
    CHECK(errors.gain >= least_gain);
    CHECK(errors.ratio > 0.8);
    CHECK(errors.ratio < 1.25);
  }
}

}  // namespace tyndall::test::gain_test
