#include "core/base/math.h"
#include "core/base/elementary.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

using namespace tyndall;  // its functions are called by their full names: the C library has the same ones

namespace {

double wide(float v) { return static_cast<double>(v); }

/// Largest distance of f from reference over a grid of n steps from low to high, both ends included.
template <class F, class Reference>
double largest_error(F f, Reference reference, double low, double high, int n, bool relative = false) {
  double maximum = 0;
  for (int i = 0; i <= n; ++i) {
    const float x = static_cast<float>(low + (high - low) * i / n);
    const double expected = reference(wide(x));
    const double error = std::abs(wide(f(x)) - expected);
    if (!std::isfinite(error)) return error;
    maximum = std::max(maximum, relative ? error / std::abs(expected) : error);
  }
  return maximum;
}

}  // namespace

TEST_CASE("sin_cos_turn: absolute error below 2.5e-7 over the whole turn") {
  const auto sine = [](float t) { return tyndall::sin_cos_2pi(t).sin; };
  const auto cosine = [](float t) { return tyndall::sin_cos_2pi(t).cos; };
  const auto std_sine = [](double t) { return std::sin(2 * pi * t); };
  const auto std_cosine = [](double t) { return std::cos(2 * pi * t); };
  const double last = 1 - 0x1p-24;
  CHECK(largest_error(sine, std_sine, 0, last, 2000000) < 2.5e-7);
  CHECK(largest_error(cosine, std_cosine, 0, last, 2000000) < 2.5e-7);
  CHECK(largest_error(sine, std_sine, 0, 1e-4, 10000) < 2.5e-7);
  CHECK(largest_error(sine, std_sine, 1 - 1e-4, last, 10000) < 2.5e-7);
  CHECK(tyndall::sin_cos_2pi(0.0f).cos == doctest::Approx(1).epsilon(2.5e-7).scale(0));
  CHECK(std::abs(tyndall::sin_cos_2pi(1.0f).sin) < 2.5e-7f);  // turn - floor(turn) can round to 1
}

TEST_CASE("sin_cos_turn: the point is on the unit circle to rounding") {
  for (int i = 0; i < 100000; ++i) {
    const SinCos<float> a = tyndall::sin_cos_2pi(static_cast<float>(i) / 100000.0f);
    CHECK_MESSAGE(std::abs(wide(a.sin) * wide(a.sin) + wide(a.cos) * wide(a.cos) - 1) < 4e-7, i);
  }
}

TEST_CASE("log: relative error below 2e-7, absolute near 1") {
  const auto f = [](float x) { return tyndall::log(x); };
  const auto reference = [](double x) { return std::log(x); };
  for (const double low : {1e-37, 0x1p-32, 1e-8, 1e-3, 0.3, 2.0, 1e3, 1e20})
    CHECK(largest_error(f, reference, low, 2 * low, 300000, true) < 2e-7);
  CHECK(largest_error(f, reference, 0.5, 2, 3000000) < 2e-7);
  CHECK(tyndall::log(1.0f) == 0.0f);
  CHECK(tyndall::log(std::nextafter(1.0f, 0.0f)) < 0.0f);  // a free flight of -tyndall::log(u) is not negative
  CHECK(wide(tyndall::log(std::numeric_limits<float>::max())) ==
        doctest::Approx(std::log(3.4028235e38)).epsilon(2.5e-7).scale(0));
  CHECK(wide(tyndall::log(std::numeric_limits<float>::min())) ==
        doctest::Approx(std::log(1.17549435e-38)).epsilon(2.5e-7).scale(0));
}

TEST_CASE("exp: relative error below 4e-7 for |x| below 10, and useful up to 80") {
  const auto f = [](float x) { return tyndall::exp(x); };
  const auto reference = [](double x) { return std::exp(x); };
  CHECK(largest_error(f, reference, -10, 10, 3000000, true) < 4e-7);
  CHECK(largest_error(f, reference, -80, 80, 1000000, true) < 4e-6);
  CHECK(tyndall::exp(0.0f) == 1.0f);
  CHECK(wide(tyndall::exp(-1e30f)) == doctest::Approx(std::exp(-80.0)).epsilon(4e-6).scale(0));
  CHECK(tyndall::exp(-std::numeric_limits<float>::infinity()) == tyndall::exp(-80.0f));
  for (float x = -90; x < 79; x += 0.37f) CHECK(tyndall::exp(x) <= tyndall::exp(x + 0.37f));
}

TEST_CASE("cube_root: is right on [0, 1]; for 0 the result is below 1e-12") {
  const auto f = [](float x) { return tyndall::cube_root(x); };
  CHECK(largest_error(
            f, [](double x) { return std::cbrt(x); }, 0x1p-24, 1, 1000000, true) < 2e-6);
  CHECK(largest_error(
            f, [](double x) { return std::cbrt(x); }, 1e-30, 1e-6, 1000000, true) < 1e-5);
  CHECK(tyndall::cube_root(0.0f) >= 0.0f);
  CHECK(tyndall::cube_root(0.0f) < 1e-12f);
  CHECK(tyndall::cube_root(1.0f) == 1.0f);
}

TEST_CASE("atan2: absolute error below 3e-7 in all directions and magnitudes") {
  double maximum = 0;
  for (const double size : {1e-30, 1e-3, 1.0, 1e3, 1e30})
    for (int i = 0; i < 400000; ++i) {
      const double angle = 2 * pi * i / 400000;
      const float x = static_cast<float>(size * std::cos(angle)), y = static_cast<float>(size * std::sin(angle));
      maximum = std::max(maximum, std::abs(wide(tyndall::atan2(y, x)) - std::atan2(wide(y), wide(x))));
    }
  CHECK(maximum < 3e-7);
}

TEST_CASE("atan2: is right on the axes, for zeros of both signs and at the origin") {
  CHECK(tyndall::atan2(0.0f, 0.0f) == 0.0f);
  CHECK(tyndall::atan2(0.0f, 5.0f) == 0.0f);
  CHECK(wide(tyndall::atan2(0.0f, -5.0f)) == doctest::Approx(pi));
  CHECK(wide(tyndall::atan2(-0.0f, -5.0f)) == doctest::Approx(-pi));
  CHECK(wide(tyndall::atan2(2.0f, 0.0f)) == doctest::Approx(pi / 2));
  CHECK(wide(tyndall::atan2(-2.0f, 0.0f)) == doctest::Approx(-pi / 2));
}

TEST_CASE("acos: over [-1, 1], also next to the ends") {
  const auto f = [](float x) { return tyndall::acos(x); };
  const auto reference = [](double x) { return std::acos(x); };
  CHECK(largest_error(f, reference, -1, 1, 2000000) < 4e-7);
  CHECK(largest_error(f, reference, 1 - 1e-5, 1, 100000) < 4e-7);
  CHECK(largest_error(f, reference, -1, -1 + 1e-5, 100000) < 4e-7);
  CHECK(tyndall::acos(1.0f) == 0.0f);
  CHECK(wide(tyndall::acos(-1.0f)) == doctest::Approx(pi));
}

TEST_CASE("in double the functions are the standard library's") {
  CHECK(tyndall::sin_cos_2pi(0.125).sin == std::sin(2 * pi * 0.125));
  CHECK(tyndall::log(0.3) == std::log(0.3));
  CHECK(tyndall::exp(-3.2) == std::exp(-3.2));
  CHECK(tyndall::exp(-100.0) == std::exp(-80.0));
  CHECK(tyndall::atan2(0.3, -0.7) == std::atan2(0.3, -0.7));
}

TEST_CASE("basis_around: gives unit vectors at right angles, right-handed, also near the poles") {
  std::mt19937 engine(1);
  std::normal_distribution<float> normal;
  const auto check = [](Vec3f n) {
    const Basis<float> b = basis_around(n);
    const Vec3f up = cross(b.s, b.t);
    CAPTURE(n.x);
    CAPTURE(n.y);
    CAPTURE(n.z);
    CHECK(std::abs(length(b.s) - 1) < 1e-6f);
    CHECK(std::abs(length(b.t) - 1) < 1e-6f);
    CHECK(std::abs(dot(b.s, b.t)) < 1e-6f);
    CHECK(length(up - n) < 1e-6f);
  };
  for (int i = 0; i < 20000; ++i) check(normalize(Vec3f{normal(engine), normal(engine), normal(engine)}));
  for (const float z : {1.0f, -1.0f}) {
    check({0, 0, z});
    for (const float tilt : {1e-20f, 1e-7f, 1e-5f, 1e-3f, 1e-2f}) check(normalize(Vec3f{tilt, -tilt, z}));
  }
  for (const float zero : {0.0f, -0.0f}) check({0.6f, -0.8f, zero});
}

namespace elementary_test {

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
