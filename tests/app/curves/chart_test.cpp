#include "app/curves/chart.h"
#include "app/curves/curve.h"
#include "core/image/image_io.h"
#include "core/scene/load.h"
#include "tests/support/curves.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tyndall::test::chart_test {

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

namespace {

void run(Convergence& runs, std::uint64_t edit, const std::string& method, double seconds) {
  for (double s = 0.1; s <= seconds; s *= 1.2) runs.add(edit, method, {s, 0.01 / s});
}

/// Runs of three seconds, one after the other.
Convergence runs_of(std::initializer_list<const char*> methods) {
  Convergence runs;
  for (const char* method : methods) run(runs, runs.current().edit + 1, method, 3);
  return runs;
}

}  // namespace

TEST_CASE("runs that lasted for a while are kept, the short ones of a drag are not") {
  Convergence runs = runs_of({"path · random"});
  for (std::uint64_t edit = 2; edit < 50; ++edit) run(runs, edit, "mis · sobol", 0.3);
  run(runs, 50, "mis · sobol", 3);
  REQUIRE(runs.earlier().size() == 1);
  CHECK(runs.earlier()[0].method == "path · random");
  CHECK(runs.current().edit == 50);
}

TEST_CASE("a newer run takes the place of the one of its method; of many methods a few stay") {
  const Convergence runs = runs_of({"mis", "path", "mis", "nee"});
  REQUIRE(runs.earlier().size() == 2);
  CHECK(runs.earlier()[0].method == "mis");
  CHECK(runs.earlier()[0].edit == 3);
  CHECK(runs.earlier()[1].method == "path");
  Convergence many;
  for (std::uint64_t edit = 1; edit < 20; ++edit) run(many, edit, "method " + std::to_string(edit % 7), 2);
  CHECK(many.earlier().size() == Convergence::max_earlier);
  CHECK(many.earlier().back().edit == 18);
  for (std::uint64_t edit = 20; edit < 24; ++edit) run(many, edit, "same", 2);
  CHECK(std::count_if(many.earlier().begin(), many.earlier().end(),
                      [](const auto& one) { return one.method == "same"; }) == 1);
}

TEST_CASE("many frames make few points, and the last frame always has one") {
  Convergence runs;
  for (int k = 1; k <= 100000; ++k) runs.add(1, "a", {k * 0.001, 1.0 / k});
  CHECK(runs.current().points.size() < 300);
  CHECK(runs.current().points.back().seconds == doctest::Approx(100));
}

TEST_CASE("errors that are unknown, or were not estimated anew, leave no point") {
  Convergence runs;
  runs.add(1, "a", {0.1, std::numeric_limits<double>::infinity()});
  runs.add(1, "a", {0.2, std::numeric_limits<double>::quiet_NaN()});
  runs.add(1, "a", {0.0, 0.5});
  CHECK(runs.current().points.empty());
  CHECK(runs.current().method == "a");
  for (int k = 1; k < 100; ++k) runs.add(1, "a", {0.1 * k, k < 50 ? 0.5 : 0.25});
  REQUIRE(runs.current().points.size() == 2);
  CHECK(runs.current().points[1].seconds == doctest::Approx(5));
}

TEST_CASE("the same picture at an earlier time, as a repeated filter gives it, leaves the curve as it is") {
  Convergence runs = runs_of({"a"});
  const std::size_t points = runs.current().points.size();
  ErrorPoint again = runs.current().points.back();
  again.seconds *= 0.99;
  runs.add(1, "a", again);
  CHECK(runs.current().points.size() == points);
  CHECK(runs.earlier().empty());
  runs.add(1, "a", {0.05, 1});  // starting over, which is a run of its own though the edit is the same
  CHECK(runs.current().points.size() == 1);
  CHECK(runs.earlier().size() == 1);
}

TEST_CASE("curves have names of their own: two of one method, and the halves of a split view") {
  const Convergence runs = runs_of({"mis", "path", "mis", "path"}), kept = runs_of({"nee"});
  const auto named = named_curves(runs, &kept);
  REQUIRE(named.size() == 4);
  CHECK(named[0].name == "mis");
  CHECK(named[1].name == "path before");
  CHECK(named[2].name == "A: nee");
  CHECK(named[2].curve == &kept.current());
  CHECK(named[3].name == "B: path");
  CHECK(named[3].role == NamedCurve::Role::current);
  CHECK(named_curves(runs, nullptr).back().name == "path");
}

TEST_CASE("methods are named by what differs from the file's") {
  RenderSettings file, settings;
  file.max_depth = settings.max_depth = 50;
  CHECK(method_of(settings, file) == "mis · sobol");
  settings.max_depth = 5;
  settings.seed = 3;
  settings.fresnel = FresnelKind::schlick;
  CHECK(method_of(settings, file) == "mis · sobol · schlick · depth 5 · seed 3");
}

namespace {

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

}  // namespace

TEST_CASE("chart: SVG and CSV hold every curve and every point") {
  const Chart chart{"A <test>", "made up", {curve("plain, 1", 1, 0), curve("biased", 1, 0.004)}, reference_noise};
  const std::string svg = chart_svg(chart);
  CHECK(svg.find("<svg xmlns") == 0);
  CHECK(count(svg, "class=\"curve") == 2);
  CHECK(count(svg, "<circle") == 26);
  CHECK(count(svg, "class=\"bias") == 1);
  CHECK(count(svg, "A &lt;test&gt;") == 2);
  CHECK(count(svg, "biased (bias 0.004)") == 1);
  CHECK(count(svg, "prefers-color-scheme:dark") == 1);
  CHECK(count(svg, "nan") + count(svg, "{{") == 0);
  const std::string csv = chart_csv(chart);
  CHECK(csv.find("method,spp,seconds,relmse\n\"plain, 1\",1,0.001,1\n") == 0);
  CHECK(count(csv, "\n") == 27);
  CHECK(chart_table(chart) ==
        "method    to 0.01    to 0.001   speed     bias\n"
        "plain, 1  0.1 s      1 s        1x        none seen\n"
        "biased    0.171 s    -          -         0.004\n");
  Chart many = chart;
  for (int i = 0; i < 8; ++i) many.curves.push_back(curve("further", 1, 0));
  CHECK(count(chart_svg(many), "class=\"curve s1 again") == 1);  // the tenth curve has the second one's colour, dashed
}

TEST_CASE("chart: no points, and points at zero, make a chart all the same") {
  for (const Chart& chart :
       {Chart{}, Chart{"", "", {{"empty", {}}, {"exact", {{0.1, 0, 1, 0}, {0.2, -1e-9, 2, 0}}}}}}) {
    const std::string text = chart_svg(chart) + chart_table(chart);
    CHECK(count(text, "nan") + count(text, "inf") == 0);
  }
}

TEST_CASE("the live chart's curves become a table and a drawing that say what was measured") {
  const std::filesystem::path folder = scratch_folder("chart_files");
  ErrorCurve good{"mis, best", {}, 2}, biased{"schlick", {}, 1};
  for (std::uint32_t spp = 2; spp < 3000; spp += spp / 10 + 1) {
    const double noise = 1.0 / spp, seconds = 1e-3 * spp;
    good.points.push_back({seconds, noise, spp, noise});
    biased.points.push_back({seconds, noise + 0.004, spp, noise});
  }
  const Chart chart{"glass: true error against ref.exr", "8x8", {biased, good}};
  write_chart(chart, folder / "glass-chart-001.svg");
  const std::string csv = read_text(folder / "glass-chart-001.csv"), svg = read_text(folder / "glass-chart-001.svg");
  CHECK(csv.find("method,spp,seconds,relmse\nschlick,2,0.002,0.504\n") == 0);
  CHECK(count(csv, "\n\"mis, best\",2,0.002,0.5\n") == 1);
  CHECK(count(svg, ">glass: true error against ref.exr</text>") == 1);
  CHECK(count(svg, "floor 0.004") == 1);
  CHECK_THROWS_AS(write_chart(chart, folder / "no" / "a-001.svg"), ImageFileError);
}

TEST_CASE("chart: the books' method first, each improvement in turn, what a scene has no use for left out") {
  for (const auto& [scene, has, lacks] :
       {std::tuple{"cornell-smoke", "the books' method; + light sampling; + MIS; + Sobol'; ", "exact Fresnel"},
        std::tuple{"cover", "the books' method; + exact Fresnel; + Sobol'; + splitting; ", "light sampling"},
        std::tuple{"cover", "+ clean (filtered); + adaptive; Schlick; ", "chains"},
        std::tuple{"showroom", "+ Sobol'; + splitting; ", "chains"},  // no light small enough
        std::tuple{"stress-caustic-glass", "+ Sobol'; + chains; + splitting; ", "guided"},
        std::tuple{"stress-two-balls", "+ Sobol'; + chains, guided light; + splitting; ", "+ chains;"},
        std::tuple{"stress-small-fuzz", "+ Sobol'; + guided light; ", "splitting"},
        std::tuple{"cornell-box", "the books' method; ", "splitting"}}) {
    CAPTURE(scene);
    std::string names;
    for (const ChartMethod& m : default_methods(load_scene(scene).scene)) {
      names += m.name + "; ";
      CHECK((m.settings.adaptive == (m.name == "+ adaptive") && m.clean == (m.name == "+ clean (filtered)")));
    }
    CHECK(names.find("the books' method; ") == 0);
    CHECK(count(names, has) == 1);
    CHECK(count(names, lacks) == 0);
  }
}

}  // namespace tyndall::test::chart_test
