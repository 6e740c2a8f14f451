#include "app/window/edit/arrange.h"

#include <doctest/doctest.h>

#include <cmath>

namespace tyndall::test::drag_rounding_test {

TEST_CASE("grains are 1, 2 or 5 times a power of ten, and never larger than asked for") {
  CHECK(nice_below(0.7).size() == 0.5);
  CHECK(nice_below(0.5).size() == 0.5);
  CHECK(nice_below(3.9).size() == 2);
  CHECK(nice_below(1000).size() == 1000);
  CHECK(nice_below(0.00199).size() == doctest::Approx(0.001));
  CHECK(decimal_below(99).size() == 10);
  CHECK(decimal_below(0.1).size() == doctest::Approx(0.1));
}

TEST_CASE("rounded numbers are those that a person would type") {
  CHECK(rounded(0.30000000000000004, DragRounding{1, -2}) == 0.3);
  CHECK(rounded(0.1234, DragRounding{5, -2}) == 0.1);
  CHECK(rounded(0.13, DragRounding{5, -2}) == 0.15);
  CHECK(rounded(1234.6, DragRounding{2, 1}) == 1240);
  CHECK_FALSE(std::signbit(rounded(-0.001, DragRounding{1, -2})));
  CHECK(without_noise(0.1 + 0.2) == 0.3);
  CHECK(without_noise(1e-7 / 3) == doctest::Approx(1e-7 / 3).epsilon(1e-11).scale(0));
  CHECK(without_noise(0) == 0);
}

}  // namespace tyndall::test::drag_rounding_test
