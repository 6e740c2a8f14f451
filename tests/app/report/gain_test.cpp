#include "app/report/gain.h"

#include "tests/support/pictures.h"
#include "tests/support/prepared.h"

#include <doctest/doctest.h>

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

}  // namespace tyndall::test::gain_test
