#include "core/base/elementary.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace elementary_test {
using namespace tyndall;

/// The largest error over 50,000 numbers from low to high, in units in the last place of what is right. right: in long
/// double, where that has more digits.
template <class Ours, class Right>
double worst_error(double low, double high, const Ours& ours, const Right& right) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> number(low, high);
  double worst = 0;
  for (int k = 0; k < 50000; ++k) {
    const double x = number(random);
    const long double expected = right(static_cast<long double>(x));
    const double size = std::abs(static_cast<double>(expected));
    const double unit = std::nextafter(size, std::numeric_limits<double>::infinity()) - size;
    worst = std::max(worst, static_cast<double>(std::abs(static_cast<long double>(ours(x)) - expected)) / unit);
  }
  return worst;
}

using Long = long double;

TEST_CASE("elementary functions are right to less than a unit in the last place") {
  for (const double high : {1e-6, 0.7, 10.0, 1e5}) {
    CHECK(worst_error(-high, high, sine, [](Long x) { return std::sin(x); }) < 1);
    CHECK(worst_error(-high, high, cosine, [](Long x) { return std::cos(x); }) < 1);
    CHECK(worst_error(-high, high, tangent, [](Long x) { return std::tan(x); }) < 1);
  }
  CHECK(worst_error(-1, 1, arc_cosine, [](Long x) { return std::acos(x); }) < 1);
  CHECK(worst_error(0.999, 1, arc_cosine, [](Long x) { return std::acos(x); }) < 1);
  for (const double x : {-3.0, -1e-3, 1e-3, 1.0, 1e4}) {
    const auto ours = [x](double y) { return arc_tangent(y, x); };
    CHECK(worst_error(-2, 2, ours, [x](Long y) { return std::atan2(y, static_cast<Long>(x)); }) < 1);
  }
  for (const double high : {1.0, 2.0, 1e9})
    CHECK(worst_error(1e-9 * high, high, binary_logarithm, [](Long x) { return std::log2(x); }) < 1);
  for (const double exponent : {-4 / 13.0, 1 / 3.0, 1 / 2.4, 2.2, 3.25, 20.0}) {
    const auto ours = [exponent](double x) { return to_the_power(x, exponent); };
    CHECK(worst_error(1e-5, 2, ours, [exponent](Long x) { return std::pow(x, static_cast<Long>(exponent)); }) < 1);
  }
  CHECK(worst_error(
            -300, 300, [](double y) { return to_the_power(2, y); }, [](Long y) { return std::exp2(y); }) < 1);
}

TEST_CASE("elementary functions are exact where that is possible") {
  CHECK(sine(0) == 0);
  CHECK(cosine(0) == 1);
  CHECK(tangent(0) == 0);
  CHECK(arc_cosine(1) == 0);
  CHECK(arc_cosine(-1) == std::acos(-1.0));
  CHECK(arc_cosine(0) == std::acos(0.0));
  CHECK(arc_tangent(0, 1) == 0);
  CHECK(arc_tangent(0, 0) == 0);
  CHECK(arc_tangent(0, -1) == std::acos(-1.0));
  CHECK(arc_tangent(-0.0, -1) == -std::acos(-1.0));
  CHECK(arc_tangent(1, 0) == std::acos(0.0));
  CHECK(binary_logarithm(1) == 0);
  CHECK(binary_logarithm(1024) == 10);
  CHECK(to_the_power(1, 0.3) == 1);
  CHECK(to_the_power(0, 0.3) == 0);
  CHECK(to_the_power(2, -3) == 0.125);
  CHECK(to_the_power(10, 2) == 100);
}

}  // namespace elementary_test
