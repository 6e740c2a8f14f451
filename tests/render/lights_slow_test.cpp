#include "tests/support/probe.h"

#include <doctest/doctest.h>

namespace tyndall::test::lights_slow_test {

TEST_CASE("light: a ball so far away that one path in ten thousand finds it") {
  Scene scene = dark_room();
  add(scene, Quad<>{{-0.05, 0, -0.05}, {0, 0, 0.1}, {0.1, 0, 0}}, lambertian(0.8));
  add(scene, sphere({50, 100 * std::cos(pi / 6), 0}, 1), lamp(1));
  aim(scene, {0.01, 0.02, 0.005}, {0, 0, 0});
  ZScores scores;
  scores.add("far lamp", radiance(scene, 1 << 17), 0.8 * 0.0002720699046351327 / pi, 0.02);
}

}  // namespace tyndall::test::lights_slow_test
