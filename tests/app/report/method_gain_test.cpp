#include "app/report/gain.h"

#include "tests/support/pictures.h"

#include <doctest/doctest.h>

namespace tyndall::test::method_gain_test {

TEST_CASE("method gain: chains take longer and leave far less error; without them nothing is measured") {
  const MethodGain shell = measure_method_gain(MisMethod::specular, small_scene("stress-bulb", 48, 36, 1), "");
  CHECK(shell.measured);
  CHECK(shell.time > 0.5);
  CHECK(shell.time < 20);
  CHECK(shell.error < 0.5);
  CHECK_FALSE(measure_method_gain(MisMethod::specular, small_scene("cornell-box", 48, 36, 1), "").measured);
}

TEST_CASE("method gain: both ways at glass leave less error; without glass nothing is measured") {
  const MethodGain spheres = measure_method_gain(MisMethod::splitting, small_scene("glass-spheres", 48, 36, 1), "");
  CHECK(spheres.measured);
  CHECK(spheres.time < 3);
  CHECK(spheres.error < 1);
  CHECK_FALSE(measure_method_gain(MisMethod::splitting, small_scene("cornell-box", 48, 36, 1), "").measured);
}

TEST_CASE(
    "method gain: sharing takes longer and leaves less error; where the sky lights the scene, nothing is measured") {
  const MethodGain box = measure_method_gain(MisMethod::sharing, close_up("cornell-box", 64, 64), "");
  CHECK(box.measured);
  CHECK(box.time > 1);
  CHECK(box.time < 5);
  CHECK(box.error < 0.8);
  CHECK_FALSE(measure_method_gain(MisMethod::sharing, small_scene("cover", 48, 36, 1), "").measured);
}

}  // namespace tyndall::test::method_gain_test
