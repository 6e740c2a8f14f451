#include "app/curves/chart.h"

#include "core/image/image_io.h"
#include "core/scene/load.h"
#include "tests/support/curves.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

namespace tyndall::test::chart_test {

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
