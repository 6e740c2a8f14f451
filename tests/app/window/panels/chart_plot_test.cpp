#include "app/window/panels/panels.h"

#include <doctest/doctest.h>

#include <cmath>

namespace tyndall::test::chart_plot_test {

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
  CHECK(found.x(found.times.maximum()) == axes.frame.x1);
  CHECK(axes_for({}, axes.frame).errors.minimum() < target_rel_mse);
}

TEST_CASE("names stand side by side while there is room, then in rows beneath") {
  const float widths[] = {60, 30, 30, 200, 10};
  const auto rows = rows_of_names(widths, {10, 5, 110, 20}, 8);
  const Rect expected[] = {{10, 5, 70, 20}, {78, 5, 108, 20}, {10, 20, 40, 35}, {10, 35, 210, 50}, {10, 50, 20, 65}};
  REQUIRE(rows.size() == std::size(expected));
  for (std::size_t i = 0; i < rows.size(); ++i) CHECK(rows[i] == expected[i]);
}

}  // namespace tyndall::test::chart_plot_test
