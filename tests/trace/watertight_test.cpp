#include "tests/support/closed_mesh.h"

#include <doctest/doctest.h>

#include <string>

namespace tyndall::test::watertight_test {

TEST_CASE("triangles: no ray slips between two that share corners, from either side, at any scale, through groups") {
  const Transform turned{RotateY{33}, Translate{{3, -2, 1}}};
  for (const Kernels& kernels : available_kernels())
    for (const bool is_round : {false, true})
      for (const double scale : {1e-3, 1.0, 1e5})
        for (const bool from_within : {false, true}) {
          CAPTURE(std::string(kernels.isa));
          CAPTURE(is_round);
          CAPTURE(scale);
          CAPTURE(from_within);
          const Transform transform = scale == 1 ? turned : Transform{};
          CHECK(slip_through({6, is_round}, scale, transform, kernels, 1 << 16, from_within, 1) == 0);
        }
}

}  // namespace tyndall::test::watertight_test
