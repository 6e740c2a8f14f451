#include "app/curves/chart.h"

#include "core/image/image_io.h"
#include "tests/support/curves.h"
#include "tests/support/paths.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace tyndall::test::chart_test {
namespace fs = std::filesystem;

namespace {

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

std::string read(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("chart: SVG and CSV hold every curve and every point") {
  const Chart chart{"A <test>", "made up", {curve("plain, 1", 1, 0), curve("biased", 1, 0.004)}, reference_noise};
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
  CHECK(count(chart_svg(many), "class=\"curve s1 again") == 1);  // the tenth curve has the second one's colour, dashed
}

TEST_CASE("chart: no points, and points at zero, make a chart all the same") {
  Chart chart{"", "", {}, reference_noise};
  CHECK(chart_svg(chart).find("nan") == std::string::npos);
  chart.curves = {{"empty", {}}, {"exact", {{0.1, 0, 1, 0}, {0.2, -1e-9, 2, 0}}}};
  const std::string svg = chart_svg(chart) + chart_table(chart);
  CHECK(svg.find("nan") == std::string::npos);
  CHECK(svg.find("inf") == std::string::npos);
}

TEST_CASE("the live chart's curves become a table and a drawing that say what was measured") {
  const fs::path folder = scratch_folder() / "chart_files";
  fs::remove_all(folder);
  fs::create_directories(folder);
  ErrorCurve good{"mis, best", {}, 2}, biased{"schlick", {}, 1};
  for (std::uint32_t spp = 2; spp < 3000; spp += spp / 10 + 1) {
    const double noise = 1.0 / spp, seconds = 1e-3 * spp;
    good.points.push_back({seconds, noise, spp, noise});
    biased.points.push_back({seconds, noise + 0.004, spp, noise});
  }
  const Chart chart{"glass: true error against ref.exr", "8x8", {biased, good}};
  write_chart(chart, folder / "glass-chart-001.svg");
  const std::string csv = read(folder / "glass-chart-001.csv"), svg = read(folder / "glass-chart-001.svg");
  CHECK(csv.find("method,spp,seconds,relmse\nschlick,2,0.002,0.504\n") == 0);
  CHECK(csv.find("\n\"mis, best\",2,0.002,0.5\n") != std::string::npos);
  CHECK(svg.find(">glass: true error against ref.exr</text>") != std::string::npos);
  CHECK(svg.find("floor 0.004") != std::string::npos);
  CHECK_THROWS_AS(write_chart(chart, folder / "no" / "a-001.svg"), ImageFileError);
}

}  // namespace tyndall::test::chart_test
