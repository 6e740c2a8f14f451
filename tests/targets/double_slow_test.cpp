#include "tests/support/double_kernels.h"
#include "tests/support/pictures.h"
#include "tests/support/prepared.h"

#include <doctest/doctest.h>

#include <cmath>

namespace tyndall::test::double_test {

namespace {

std::vector<float> picture(const Kernels& kernels, const RenderScene& scene) {
  return resolve(drawn_by(kernels, scene, SceneViewOf(scene).view(), 0, 4));
}

}  // namespace

TEST_CASE("double: the kernel over double follows the same paths, except where rounding changes a decision") {
  for (const char* name : {"cornell-box", "showroom", "cornell-smoke"}) {
    const RenderScene scene = compile(small_scene(name, 48, 48, 4));
    const std::vector<float> a = picture(scalar_kernels(), scene), b = picture(double_kernels(), scene);
    int different = 0;
    for (std::size_t i = 0; i < a.size(); ++i) different += std::abs(a[i] - b[i]) > 1e-3f * (0.01f + b[i]) ? 1 : 0;
    CAPTURE(name);
    CHECK(different < 0.03 * static_cast<double>(a.size()));
    CHECK(a != b);  // or the kernel would not compute in double
  }
}

}  // namespace tyndall::test::double_test
