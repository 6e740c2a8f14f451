#include "app/window/panels/panels.h"
#include "app/window/panels/rows.h"
#include "core/base/math.h"
#include "tests/app/window/scenes.h"
#include "tests/support/metal_survival.h"

#include <cmath>

namespace tyndall::test::figures_test {

namespace {

constexpr ChartAxes axes{{-1, 2}, {-6, 0}, {100, 50, 400, 350}};

/// A curve that falls as 1 / time.
ErrorCurve falling(double rel_mse_at_1_s, double from, double to) {
  ErrorCurve run{"falling", {}};
  for (double s = from; s <= to * 1.0001; s *= 10)
    run.points.push_back({s, rel_mse_at_1_s / s, static_cast<std::uint32_t>(std::lround(100 * s)), 0});
  return run;
}

std::vector<float> picture_of(const std::vector<float>& greys) {
  std::vector<float> rgba;
  for (const float grey : greys) rgba.insert(rgba.end(), {grey, grey, grey, 1});
  return rgba;
}

/// The mean of function(x) for x from 0 to 1.
template <class Function>
double mean(int steps, const Function& function) {
  double sum = 0;
  for (int k = 0; k < steps; ++k) sum += function((k + 0.5) / steps) / steps;
  return sum;
}

}  // namespace

TEST_CASE("chart: axes give back what they were given, and hold all curves and the target") {
  CHECK(axes.x(0.1) == doctest::Approx(100));
  CHECK(axes.x(100) == doctest::Approx(400));
  CHECK(axes.y(1) == doctest::Approx(50));
  CHECK(axes.y(1e-6) == doctest::Approx(350));
  CHECK(axes.seconds(axes.x(3.5)) == about(3.5));
  CHECK(axes.rel_mse(axes.y(0.002)) == about(0.002));
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

TEST_CASE("chart: the nearest curve at a time is found, a curve's end also a little beside it") {
  const ErrorCurve noisy = falling(0.1, 0.1, 10), good = falling(0.001, 0.1, 1), none{};
  const ErrorCurve* runs[] = {&noisy, &none, &good};
  const auto at = [&](float x, double rel_mse) { return nearest_curve(runs, axes, x, axes.y(rel_mse), 10); };
  const auto low = at(axes.x(0.5), 1e-3), end = at(axes.x(1) + 8, 1e-3);
  REQUIRE(low);
  CHECK(low->curve == 2);
  CHECK(low->at.rel_mse == about(0.002, 1e-3));
  REQUIRE(end);
  CHECK(end->curve == 2);
  CHECK(end->at.seconds == 1);
  CHECK(at(axes.x(0.5), 0.5)->curve == 0);
  CHECK(at(axes.x(1) + 12, 1e-3)->curve == 0);
  CHECK_FALSE(at(axes.x(10) + 12, 1e-3));
}

TEST_CASE("chart: names stand side by side while there is room, then in rows beneath") {
  const float widths[] = {60, 30, 30, 200, 10};
  const std::vector<Rect> expected{
      {10, 5, 70, 20}, {78, 5, 108, 20}, {10, 20, 40, 35}, {10, 35, 210, 50}, {10, 50, 20, 65}};
  CHECK(rows_of_names(widths, {10, 5, 110, 20}, 8) == expected);
}

TEST_CASE("histogram: counts what the screen shows, with exposure and curve, and tells what is clipped") {
  std::vector<float> greys(1000, 0.5f);
  std::fill(greys.begin(), greys.begin() + 100, 2.0f);
  std::fill(greys.begin() + 100, greys.begin() + 150, 0.0f);
  Display display;
  const Histogram histogram = histogram_of(picture_of(greys), display);
  CHECK(histogram.pixels == 1000);
  CHECK(histogram.white == doctest::Approx(0.1));
  CHECK(histogram.black == doctest::Approx(0.05));
  CHECK(histogram.counts[1][188 * 64 / 256] == 850);  // 0.5 is 188 on the screen
  CHECK(histogram.counts[2][63] == 100);
  CHECK(histogram_of({0, 1, 0, 1}, display).white == 1);  // one channel is enough
  display.exposure = 2;
  CHECK(histogram_of(picture_of(greys), display).white == doctest::Approx(0.95));
  display.exposure = 0, display.tone_map = ToneMap::aces;
  CHECK(histogram_of(picture_of(greys), display).white == 0);
}

TEST_CASE("histogram: of a large picture a part of the pixels is counted, from all of it") {
  std::vector<float> greys(640 * 480, 0.2f);
  std::fill_n(greys.begin(), greys.size() / 4, 3.0f);
  const Histogram histogram = histogram_of(picture_of(greys), {});
  CHECK(histogram.pixels > 10000);
  CHECK(histogram.pixels < 20000);
  CHECK(histogram.white == about(0.25, 0.02));
}

TEST_CASE("what fuzz loses and fog sends on is the integral over the directions") {
  for (const double fuzz : {0.05, 0.18, 0.5, 1.0})
    CHECK(fuzz_loss(fuzz) == about(mean(20000, [&](double c) { return 2 * c * (1 - metal_survival(fuzz, c)); })));
  for (const double g : {-0.8, -0.1, 0.0005, 0.3, 0.9})
    CHECK(forward_fraction(g) == about(mean(200000, [&](double c) { return 2 * pi * henyey_greenstein_pdf(g, c); })));
  CHECK(forward_fraction(0) == 0.5);
}

TEST_CASE("rows say what their values mean") {
  Camera camera;
  camera.vfov = 53.13;
  const Disk<> ring{{0, 0, 0}, {3, 4, 0}, {0, 0, 0.5}, 0.25};
  for (const auto& [said, expected] : std::initializer_list<std::pair<std::string, std::string>>{
           {meaning(Metal<>{0.18}, "fuzz"), "0.3 % of the light lost below the surface"},
           {meaning(Metal<>{0}, "fuzz"), "a perfect mirror"},
           {meaning(Dielectric<>{1.5}, "refractive_index"), "reflects 4.0 % head on, all beyond 41.8°"},
           {meaning(Dielectric<>{1 / 1.5}, "refractive_index"), "reflects 4.0 %, all beyond 41.8° outside"},
           {meaning(Dielectric<>{1}, "refractive_index"), "as the surroundings: invisible"},
           {meaning(Medium<>{1.1, 0}, "density"), "mean free path 0.909"},
           {meaning(Medium<>{0, 0}, "density"), "empty: light passes"},
           {meaning(Medium<>{1, 0}, "g"), "isotropic: scatters evenly"},
           {meaning(Medium<>{1, -0.9}, "g"), meaning(Medium<>{1, 0.9}, "g").substr(0, 4) + " goes back"},
           {meaning(Medium<>{1, 0.9}, "g").substr(4), " goes on forward"},
           {meaning(ring, "u"), "half axis of 5"},
           {meaning(ring, "v"), "half axis of 0.5"},
           {meaning(ring, "inner"), "a ring: the hole is 25 % as wide"},
           {meaning(Disk<>{}, "inner"), "no hole"},
           {meaning(ring, "center"), ""},
           {meaning(camera, "vfov"), "as a 24 mm lens on 35 mm film"}})
    CHECK(said == expected);
}

TEST_CASE("the sharp range: its ends blur to one pixel") {
  Camera camera;
  camera.vfov = 30;
  camera.defocus_angle = 1;
  camera.focus_distance = 5;
  const SharpRange range = sharp_range(camera, 800);
  const double lens = 5 * std::tan(pi / 360), pixel = 2 * std::tan(15 * pi / 180) / 800;
  for (const double depth : {range.near, range.far})  // size of the blur disc, seen from the lens
    CHECK(2 * lens * std::abs(1 / depth - 1 / 5.0) == about(pixel, 1e-9));
  CHECK(range.near < 5);
  CHECK(range.far > 5);
  camera.defocus_angle = 1e-3;
  CHECK(std::isinf(sharp_range(camera, 800).far));
}

}  // namespace tyndall::test::figures_test
