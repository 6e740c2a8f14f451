#include "app/report/gain.h"

#include "core/scene/load.h"
#include "tests/support/prepared.h"

#include <doctest/doctest.h>

#include <string>

/// What users are told about the kernel that renders their scene: how much faster it is than the full kernel, or that
/// there is only the full kernel.
namespace tyndall::test::kernel_gain_test {

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
  Scene scene = load_scene("cornell-box").scene;
  scene.width = scene.height = 32;
  const auto box = prepare(scene);
  if (best.set_for(box->view()) == KernelSet::everything) return;  // this processor's widest set has the full one alone
  const KernelGain gain = measure_kernel_gain(*box, best);
  CHECK(gain.isa == best.isa);
  CHECK(gain.pairs > 0);
  CHECK(gain.same_picture);
  CHECK(gain.minimum <= gain.gain);
  CHECK(gain.gain <= gain.maximum);
}

}  // namespace tyndall::test::kernel_gain_test
