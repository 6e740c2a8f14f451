#include "tests/support/pictures.h"

#include <doctest/doctest.h>

#include <string>

namespace tyndall::test::rejected_slow_test {

TEST_CASE(
    "built-in scenes: of 1024 samples a pixel none is rejected, and what limits of 200 and more cut is not seen") {
  int scenes = 0;
  for (const BuiltIn& built_in : built_in_scenes()) {
    const Scene scene = small_scene(built_in.name, 48, 36, 1024);
    const RenderScene compiled = compile(scene);
    for (const Kernels& kernels : {available_kernels().back(), scalar_kernels()}) {
      const FilmTotals sum = totals(render(compiled, {.isa = kernels.isa, .spp = kernels.lanes == 1 ? 64 : 1024}).film);
      CAPTURE(built_in.name);
      CAPTURE(std::string(kernels.isa));
      CHECK(sum.rejected == 0);
      if (scene.render.max_depth >= 200) CHECK(sum.cut_throughput < 1e-3);
      if (scene.render.max_depth >= 1000) CHECK(sum.truncated == 0);
    }
    ++scenes;
  }
  CHECK(scenes >= 40);
}

}  // namespace tyndall::test::rejected_slow_test
