#include "app/curves/curve.h"

#include "tests/support/curves.h"

#include <doctest/doctest.h>

#include <cmath>

namespace tyndall::test::curve_test {

TEST_CASE("a curve is read between its points on logarithmic scales, and not beyond them") {
  ErrorCurve falling{"falling", {}};
  for (const double seconds : {0.1, 1.0, 10.0})
    falling.points.push_back({seconds, 0.01 / seconds, static_cast<std::uint32_t>(std::lround(100 * seconds)), 0});
  const auto between = point_at(falling, std::sqrt(10.0));
  CHECK(between.value().rel_mse == doctest::Approx(0.01 / std::sqrt(10.0)));
  CHECK(between->spp == 316);
  CHECK(seconds_to(falling, between->rel_mse).value() == doctest::Approx(std::sqrt(10.0)));
  CHECK(point_at(falling, 10)->rel_mse == doctest::Approx(0.001));
  CHECK(point_at(falling, 0.1)->rel_mse == doctest::Approx(0.1));
  CHECK_FALSE(point_at(falling, 10.1));
  CHECK_FALSE(point_at(falling, 0.09));
  CHECK_FALSE(point_at({}, 1));
}

TEST_CASE("chart: times to an error are read between the points, but an error of zero or less at its own point") {
  const ErrorCurve plain = curve("plain", 1, 0);
  CHECK(seconds_to(plain, 0.01).value() == doctest::Approx(0.1));
  CHECK(seconds_to(plain, 0.001).value() == doctest::Approx(1));
  CHECK(seconds_to(plain, 2).value() == doctest::Approx(1e-3));
  CHECK_FALSE(seconds_to(plain, 1e-5));
  CHECK_FALSE(seconds_to(curve("biased", 1, 0.02), 0.01));
  CHECK(seconds_to({"exact", {{1, 0.1}, {2, 0}}}, 0.01).value() == 2);
  CHECK(seconds_to({"below the reference's noise", {{1, 0.1}, {4, -1e-9}}}, 0.01).value() == 4);
}

TEST_CASE("time to a target: four times as long for half the error, less what has passed since the estimate") {
  CHECK(seconds_left(0.01, {10, 0.0004}, 10) == doctest::Approx(30));
  CHECK(seconds_left(0.01, {10, 0.0004}, 25) == doctest::Approx(15));
  CHECK(seconds_left(0.01, {10, 0.0001}, 10) == 0);
  CHECK(seconds_left(0.01, {10, 0.00001}, 10) == 0);
}

TEST_CASE("chart: an error that stops falling is called bias, noise and rare bright samples are not") {
  CHECK_FALSE(bias_of(curve("plain", 1, 0), reference_noise));
  CHECK(bias_of(curve("biased", 1, 0.004), reference_noise).value() == doctest::Approx(0.004));
  CHECK_FALSE(bias_of(curve("hidden by noise", 1, 1e-5), reference_noise));
  ErrorCurve tail = curve("heavy tail", 1, 0);
  for (ErrorPoint& p : tail.points) p.noise *= 0.6;  // the noise that the halves show is too small
  CHECK_FALSE(bias_of(tail, reference_noise));
  ErrorCurve often{"heavy tail, measured often", {}};
  for (double spp = 16; spp < 4096; spp *= 1.05)
    often.points.push_back({1e-3 * spp, 1 / spp, static_cast<std::uint32_t>(spp), 0.4 / spp});
  CHECK_FALSE(bias_of(often, reference_noise));
  for (ErrorPoint& p : often.points) p.rel_mse += 0.004;
  CHECK(bias_of(often, reference_noise).value() == doctest::Approx(0.004).epsilon(0.1).scale(0));
}

TEST_CASE("chart: speeds are compared at the smallest error that both curves reach") {
  const ErrorCurve slow{"slow", {{1, 0.1, 1, 0}, {10, 0.01, 2, 0}}};
  CHECK(speed_against(slow, slow) == doctest::Approx(1));
  CHECK(speed_against(slow, {"fast", {{0.01, 0.1, 1, 0}, {0.1, 0.01, 2, 0}, {1, 0.001, 4, 0}}}) ==
        doctest::Approx(100));
  CHECK(speed_against(slow, {"short", {{0.01, 1, 1, 0}, {0.1, 0.1, 2, 0}}}) == doctest::Approx(10));
  CHECK_FALSE(speed_against(slow, {"empty", {}}));
  CHECK_FALSE(speed_against({"exact", {{1, 0, 1, 0}}}, {"exact", {{1, 0, 1, 0}}}));
}

}  // namespace tyndall::test::curve_test
