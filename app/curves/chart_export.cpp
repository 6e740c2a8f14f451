#include "app/curves/chart_export.h"

#include "app/files/outputs.h"

namespace tyndall {

Chart live_chart(const std::vector<NamedRun>& runs, const std::string& title, const std::string& subtitle) {
  Chart chart{title, subtitle, {}, {}};
  for (const NamedRun& named : runs) {
    ChartCurve curve{named.name, {}};
    for (const ConvergencePoint& p : named.run->points) curve.points.push_back({p.spp, p.seconds, p.rel_mse, p.noise});
    if (!curve.points.empty()) chart.curves.push_back(std::move(curve));
  }
  return chart;
}

std::string write_chart(const Chart& chart, const std::filesystem::path& base) {
  write_text_file(base.string() + ".csv", chart_csv(chart));
  write_text_file(base.string() + ".svg", chart_svg(chart));
  return "saved " + base.filename().string() + ".csv and .svg";
}

}  // namespace tyndall
