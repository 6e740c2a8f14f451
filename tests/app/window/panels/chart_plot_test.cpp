#include "app/window/panels/chart_plot.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace tyndall;

namespace {

/// A curve that falls as 1 / time.
ConvergenceRun falling(double rel_mse_at_1_s, double from, double to) {
  ConvergenceRun run{1, "falling", {}};
  for (double s = from; s <= to * 1.0001; s *= 10)
    run.points.push_back({s, rel_mse_at_1_s / s, static_cast<std::uint32_t>(std::lround(100 * s)), 0});
  return run;
}

constexpr ChartAxes axes{{-1, 2, -6, 0}, {100, 50, 400, 350}};

}  // namespace

TEST_CASE("a curve is read between its points on logarithmic scales, and not beyond them") {
  const ConvergenceRun run = falling(0.01, 0.1, 10);
  const auto between = point_at(run, std::sqrt(10.0));
  REQUIRE(between);
  CHECK(between->rel_mse == doctest::Approx(0.01 / std::sqrt(10.0)));
  CHECK(between->spp == 316);
  CHECK(point_at(run, 10)->rel_mse == doctest::Approx(0.001));
  CHECK(point_at(run, 0.1)->rel_mse == doctest::Approx(0.1));
  CHECK_FALSE(point_at(run, 10.1));
  CHECK_FALSE(point_at(run, 0.09));
  CHECK_FALSE(point_at({}, 1));
}

TEST_CASE("axes give back what they were given") {
  CHECK(axes.x(0.1) == doctest::Approx(100));
  CHECK(axes.x(100) == doctest::Approx(400));
  CHECK(axes.y(1) == doctest::Approx(50));
  CHECK(axes.y(1e-6) == doctest::Approx(350));
  CHECK(axes.seconds(axes.x(3.5)) == doctest::Approx(3.5).epsilon(1e-4));
  CHECK(axes.rel_mse(axes.y(0.002)) == doctest::Approx(0.002).epsilon(1e-4));
}

TEST_CASE("the nearest curve at a time is found, a curve's end also a little beside it") {
  const ConvergenceRun noisy = falling(0.1, 0.1, 10), good = falling(0.001, 0.1, 1), none{};
  const ConvergenceRun* runs[] = {&noisy, &none, &good};
  const auto low = nearest_curve(runs, axes, axes.x(0.5), axes.y(1e-3), 10);
  REQUIRE(low);
  CHECK(low->run == 2);
  CHECK(low->at.rel_mse == doctest::Approx(0.002).epsilon(1e-3));
  CHECK(nearest_curve(runs, axes, axes.x(0.5), axes.y(0.5), 10)->run == 0);
  const auto end = nearest_curve(runs, axes, axes.x(1) + 8, axes.y(1e-3), 10);
  REQUIRE(end);
  CHECK(end->run == 2);
  CHECK(end->at.seconds == 1);
  CHECK(nearest_curve(runs, axes, axes.x(1) + 12, axes.y(1e-3), 10)->run == 0);
  CHECK_FALSE(nearest_curve(runs, axes, axes.x(10) + 12, axes.y(1e-3), 10));
}

TEST_CASE("decades hold all curves and the target") {
  const ConvergenceRun run = falling(0.5, 0.02, 30), low = falling(1e-6, 1, 1);
  const ConvergenceRun* runs[] = {&run, &low};
  const Decades d = decades_of(runs);
  CHECK(d.x0 == -2);
  CHECK(d.x1 == 2);
  CHECK(d.y0 <= -7);
  CHECK(d.y1 == 2);
}
