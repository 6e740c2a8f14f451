#include "app/window/panels/chart_plot.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace tyndall;

namespace {

/// A curve that falls as 1 / time.
ErrorCurve falling(double rel_mse_at_1_s, double from, double to) {
  ErrorCurve run{"falling", {}};
  for (double s = from; s <= to * 1.0001; s *= 10)
    run.points.push_back({s, rel_mse_at_1_s / s, static_cast<std::uint32_t>(std::lround(100 * s)), 0});
  return run;
}

constexpr ChartAxes axes{{-1, 2}, {-6, 0}, {100, 50, 400, 350}};

}  // namespace

TEST_CASE("axes give back what they were given") {
  CHECK(axes.x(0.1) == doctest::Approx(100));
  CHECK(axes.x(100) == doctest::Approx(400));
  CHECK(axes.y(1) == doctest::Approx(50));
  CHECK(axes.y(1e-6) == doctest::Approx(350));
  CHECK(axes.seconds(axes.x(3.5)) == doctest::Approx(3.5).epsilon(1e-4).scale(0));
  CHECK(axes.rel_mse(axes.y(0.002)) == doctest::Approx(0.002).epsilon(1e-4).scale(0));
}

TEST_CASE("the nearest curve at a time is found, a curve's end also a little beside it") {
  const ErrorCurve noisy = falling(0.1, 0.1, 10), good = falling(0.001, 0.1, 1), none{};
  const ErrorCurve* runs[] = {&noisy, &none, &good};
  const auto low = nearest_curve(runs, axes, axes.x(0.5), axes.y(1e-3), 10);
  REQUIRE(low);
  CHECK(low->curve == 2);
  CHECK(low->at.rel_mse == doctest::Approx(0.002).epsilon(1e-3).scale(0));
  CHECK(nearest_curve(runs, axes, axes.x(0.5), axes.y(0.5), 10)->curve == 0);
  const auto end = nearest_curve(runs, axes, axes.x(1) + 8, axes.y(1e-3), 10);
  REQUIRE(end);
  CHECK(end->curve == 2);
  CHECK(end->at.seconds == 1);
  CHECK(nearest_curve(runs, axes, axes.x(1) + 12, axes.y(1e-3), 10)->curve == 0);
  CHECK_FALSE(nearest_curve(runs, axes, axes.x(10) + 12, axes.y(1e-3), 10));
}

TEST_CASE("the axes hold all curves and the target") {
  const ErrorCurve run = falling(0.5, 0.02, 30), low = falling(1e-6, 1, 1);
  const ErrorCurve* runs[] = {&run, &low};
  const ChartAxes found = axes_for(runs, axes.frame);
  CHECK(found.times.first == -2);
  CHECK(found.times.last == 2);
  CHECK(found.errors.first <= -7);
  CHECK(found.errors.last == 2);
  CHECK(found.x(found.times.most()) == axes.frame.x1);
  CHECK(axes_for({}, axes.frame).errors.least() < target_rel_mse);
}

TEST_CASE("a curve crosses a rectangle where it goes through it, not where it passes by") {
  const ErrorCurve curve = falling(0.01, 0.1, 10);
  const ErrorCurve* const curves[] = {&curve};
  const float x = axes.x(1), y = axes.y(0.01);  // from there it falls by one pixel for every two
  CHECK(any_crosses(curves, axes, {x - 5, y - 5, x + 5, y + 5}));
  CHECK(any_crosses(curves, axes, {x + 24, y + 2, x + 28, y + 30}));  // between two points
  CHECK_FALSE(any_crosses(curves, axes, {x - 45, y + 5, x - 5, y + 15}));
  CHECK_FALSE(any_crosses(curves, axes, {x + 25, y - 40, x + 45, y - 5}));
  CHECK_FALSE(any_crosses(curves, axes, {axes.x(10) + 1, y, axes.x(10) + 9, y + 200}));
  CHECK_FALSE(any_crosses({}, axes, axes.frame));
}
