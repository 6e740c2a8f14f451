#include "app/curves/svg.h"

#include "core/scene/load.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace tyndall;

namespace {

/// Error as noise / spp + bias, at 1 ms a sample.
ChartCurve curve(const std::string& name, double noise, double bias) {
  ChartCurve curve{name, {}};
  for (std::uint32_t spp = 1; spp <= 4096; spp *= 2)
    curve.points.push_back({spp, 1e-3 * spp, noise / spp + bias, noise / spp});
  return curve;
}

const ChartReference reference{{}, 1e-6, "made up"};

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

}  // namespace

TEST_CASE("chart: times to an error are read between the points, on logarithmic scales") {
  const ChartCurve plain = curve("plain", 1, 0);
  CHECK(seconds_to(plain, 0.01).value() == doctest::Approx(0.1));
  CHECK(seconds_to(plain, 0.001).value() == doctest::Approx(1));
  CHECK(seconds_to(plain, 2).value() == doctest::Approx(1e-3));
  CHECK_FALSE(seconds_to(plain, 1e-5));
  CHECK_FALSE(seconds_to(curve("biased", 1, 0.02), 0.01));
}

TEST_CASE("chart: a floor is bias, noise and heavy tails are not") {
  CHECK_FALSE(bias_of(curve("plain", 1, 0), reference));
  CHECK(bias_of(curve("biased", 1, 0.004), reference).value() == doctest::Approx(0.004));
  CHECK_FALSE(bias_of(curve("hidden by noise", 1, 1e-5), reference));
  ChartCurve tail = curve("heavy tail", 1, 0);
  for (ChartPoint& p : tail.points) p.noise *= 0.6;  // the halves see too little, ever less of it
  CHECK_FALSE(bias_of(tail, reference));
  ChartCurve often{"heavy tail, measured often", {}};
  for (double spp = 16; spp < 4096; spp *= 1.05)
    often.points.push_back({static_cast<std::uint32_t>(spp), 1e-3 * spp, 1 / spp, 0.4 / spp});
  CHECK_FALSE(bias_of(often, reference));
  for (ChartPoint& p : often.points) p.rel_mse += 0.004;
  CHECK(bias_of(often, reference).value() == doctest::Approx(0.004).epsilon(0.1));
}

TEST_CASE("chart: the books' method first, each improvement in turn, what a scene has no use for left out") {
  const auto names = [](const char* scene) {
    std::string all;
    for (const ChartMethod& m : default_methods(load_scene(scene).scene)) all += m.name + "; ";
    return all;
  };
  CHECK(names("cornell-smoke").find("the books' method; + light sampling; + MIS; + Sobol'; ") == 0);
  CHECK(names("cover").find("the books' method; + exact Fresnel; + Sobol'; ") == 0);
  CHECK(names("cover").find("light sampling") == std::string::npos);
  CHECK(names("cover").find("+ adaptive; Schlick; ") != std::string::npos);
  for (const ChartMethod& m : default_methods(load_scene("cover").scene))
    CHECK(m.settings.adaptive == (m.name == "+ adaptive"));
}

TEST_CASE("chart: SVG and CSV hold every curve and every point") {
  const Chart chart{"A <test>", "made up", {curve("plain, 1", 1, 0), curve("biased", 1, 0.004)}, reference};
  const std::string svg = chart_svg(chart);
  CHECK(svg.find("<svg xmlns") == 0);
  CHECK(count(svg, "class=\"curve") == 2);
  CHECK(count(svg, "<circle") == 26);
  CHECK(count(svg, "class=\"bias") == 1);
  CHECK(svg.find("A &lt;test&gt;") != std::string::npos);
  CHECK(svg.find("biased (bias 0.004)") != std::string::npos);
  CHECK(svg.find("prefers-color-scheme:dark") != std::string::npos);
  CHECK(svg.find("nan") == std::string::npos);
  const std::string csv = chart_csv(chart);
  CHECK(csv.find("method,spp,seconds,relmse\n\"plain, 1\",1,0.001,1\n") == 0);
  CHECK(count(csv, "\n") == 27);
  CHECK(chart_table(chart).find("0.1 s") != std::string::npos);
  Chart many = chart;
  for (int i = 0; i < 8; ++i) many.curves.push_back(curve("further", 1, 0));
  CHECK(count(chart_svg(many), "class=\"curve s1 again") == 1);  // the tenth has the second's colour, dashed
}

TEST_CASE("chart: speed is that to the least error that both curves reach") {
  const ChartCurve slow{"slow", {{1, 1, 0.1, 0}, {2, 10, 0.01, 0}}};
  CHECK(speed_against(slow, slow) == doctest::Approx(1));
  CHECK(speed_against(slow, {"fast", {{1, 0.01, 0.1, 0}, {2, 0.1, 0.01, 0}, {4, 1, 0.001, 0}}}) ==
        doctest::Approx(100));
  CHECK(speed_against(slow, {"short", {{1, 0.01, 1, 0}, {2, 0.1, 0.1, 0}}}) == doctest::Approx(10));
  CHECK_FALSE(speed_against(slow, {"empty", {}}));
  CHECK_FALSE(speed_against({"exact", {{1, 1, 0, 0}}}, {"exact", {{1, 1, 0, 0}}}));
}

TEST_CASE("chart: no points, and points at zero, make a chart all the same") {
  Chart chart{"", "", {}, reference};
  CHECK(chart_svg(chart).find("nan") == std::string::npos);
  chart.curves = {{"empty", {}}, {"exact", {{1, 0.1, 0, 0}, {2, 0.2, -1e-9, 0}}}};
  const std::string svg = chart_svg(chart) + chart_table(chart);
  CHECK(svg.find("nan") == std::string::npos);
  CHECK(svg.find("inf") == std::string::npos);
}
