#include "tests/support/closed_mesh.h"

#include <doctest/doctest.h>

#include <string>

namespace tyndall::test::watertight_slow_test {

namespace {

void check_rays(int all) {
  const Kernels kernels = available_kernels().back();
  const Transform nowhere, turned{RotateY{33}, Translate{{3, -2, 1}}};
  for (const auto& [scale, transform] : {std::pair{1e-3, nowhere}, {1.0, nowhere}, {1.0, turned}, {1e5, nowhere}})
    for (const bool from_within : {false, true}) {
      int leaks = 0;
      for (const bool is_round : {false, true})
        for (const int n : {3, 40})
          leaks += slip_through({n, is_round}, scale, transform, kernels, all / 4, from_within, 2);
      CHECK(leaks == 0);
      std::string told(kernels.isa);
      told += transform.empty() ? "" : ", turned and moved";
      told += from_within ? ", from within" : ", from outside";
      MESSAGE(told, ", scale ", scale, ": ", leaks, " of ", all, " rays slip through");
    }
}

}  // namespace

TEST_CASE("triangles: of 10^7 rays at edges and corners none slips through, from either side, at any scale") {
  check_rays(10'000'000);
}

// A quarter of an hour: slow_tests -tc="*10^8 rays*" --no-skip
TEST_CASE("triangles: of 10^8 rays none slips through" * doctest::skip()) { check_rays(100'000'000); }

}  // namespace tyndall::test::watertight_slow_test
