#include "app/curves/chart_export.h"

#include "core/image/image_io.h"
#include "tests/support/paths.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

using namespace tyndall;
namespace fs = std::filesystem;

namespace {

std::string read(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("the live chart becomes a table and a drawing that say what was measured") {
  const fs::path folder = scratch_folder() / "chart_export";
  fs::remove_all(folder);
  fs::create_directories(folder);
  ConvergenceRun good{2, "mis, best", {}}, biased{1, "schlick", {}};
  for (std::uint32_t spp = 2; spp < 3000; spp += spp / 10 + 1) {
    const double noise = 1.0 / spp, seconds = 1e-3 * spp;
    good.points.push_back({seconds, noise, spp, noise});
    biased.points.push_back({seconds, noise + 0.004, spp, noise});
  }
  const ConvergenceRun none;
  using Role = NamedRun::Role;
  const std::vector<NamedRun> runs{
      {Role::earlier, &none, "none"}, {Role::earlier, &biased, biased.method}, {Role::current, &good, good.method}};
  const Chart chart = live_chart(runs, "glass: true error against ref.exr", "8x8");
  REQUIRE(chart.curves.size() == 2);
  CHECK(write_chart(chart, folder / "glass-chart-001") == "saved glass-chart-001.csv and .svg");
  const std::string csv = read(folder / "glass-chart-001.csv"), svg = read(folder / "glass-chart-001.svg");
  CHECK(csv.find("method,spp,seconds,relmse\nschlick,2,0.002,0.504\n") == 0);
  CHECK(csv.find("\n\"mis, best\",2,0.002,0.5\n") != std::string::npos);
  CHECK(svg.find(">glass: true error against ref.exr</text>") != std::string::npos);
  CHECK(svg.find("floor 0.004") != std::string::npos);
  CHECK_THROWS_AS(write_chart(chart, folder / "no" / "a-001"), ImageFileError);
}
