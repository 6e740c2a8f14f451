#include "tests/support/closed_mesh.h"
#include "tests/support/thorough.h"

#include <doctest/doctest.h>

#include <string>

namespace tyndall::test::watertight_test {

TEST_CASE("triangles: no ray slips between two that share corners, from either side, at any scale, through groups") {
  const Transform turned{RotateY{33}, Translate{{3, -2, 1}}};
  constexpr int cells[] = {6, 3, 40};
  const int rays = thorough() ? 10'000'000 / 6 : 1 << 16;  // 10^7 from each side at each scale
  for (const Kernels& kernels : available_kernels())
    for (const bool is_round : {false, true})
      for (const int n : tried(cells, 1))
        for (const double scale : {1e-3, 1.0, 1e5})
          for (const bool from_within : {false, true}) {
            CAPTURE(std::string(kernels.isa));
            CAPTURE(is_round);
            CAPTURE(n);
            CAPTURE(scale);
            CAPTURE(from_within);
            const Transform transform = scale == 1 ? turned : Transform{};
            CHECK(slip_through({n, is_round}, scale, transform, kernels, rays, from_within, 1) == 0);
          }
}

}  // namespace tyndall::test::watertight_test
