#include "core/textures/checker.h"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>

namespace tyndall::test::checker_test {

namespace {

bool odd_by_counting(long x, long y, long z) { return ((x + y + z) % 2 + 2) % 2 == 1; }

}  // namespace

TEST_CASE("checker: cells alternate, through the origin and far from it") {
  for (const long far : {0L, -1000L, 100000L, -2000001L})
    for (long x = -4; x <= 4; ++x)
      for (long y = -4; y <= 4; ++y)
        for (long z = -4; z <= 4; ++z)
          for (const float part : {0.0f, 0.25f, 0.75f}) {
            const Vec3f cell{static_cast<float>(far + x) + part, static_cast<float>(y) + part,
                             static_cast<float>(z) + part};
            REQUIRE(checker_odd(cell) == odd_by_counting(far + x, y, z));
          }
}

TEST_CASE("checker: the cell at the origin is even, its lower neighbours are odd") {
  CHECK_FALSE(checker_odd(Vec3f{0.5f, 0.5f, 0.5f}));
  CHECK(checker_odd(Vec3f{-0.5f, 0.5f, 0.5f}));
  CHECK(checker_odd(Vec3f{0.5f, -1e-30f, 0.5f}));
  CHECK_FALSE(checker_odd(Vec3f{-0.5f, -0.5f, 0.5f}));
  CHECK(checker_odd(Vec3f{-0.5f, -0.5f, -0.5f}));
}

TEST_CASE("checker: coordinates too large to tell cells apart give one of the two colours") {
  for (const float v : {1e10f, -1e10f, 3e38f, -3e38f, INFINITY, NAN}) {
    const Vec3f cell{v, 0.5f, 0.5f};
    const bool odd = checker_odd(cell);
    CHECK(odd == checker_odd(cell));
  }
}

}  // namespace tyndall::test::checker_test
