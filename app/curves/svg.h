#pragma once
#include "app/curves/curve.h"

#include <string>
#include <vector>

namespace tyndall {

/// A chart as its files want it.
struct Chart {
  std::string title, subtitle;
  std::vector<ChartCurve> curves;
  ChartReference reference;
};

/// Seconds against relMSE, both logarithmic: curves named at their ends, a guide of slope -1, errors 0.01 and 0.001
/// marked, floors of bias dashed. Colours by Okabe and Ito (Color Universal Design, 2008), for light and dark pages.
std::string chart_svg(const Chart& chart);

/// method,spp,seconds,relmse with a line for each point.
std::string chart_csv(const Chart& chart);

/// For each method: seconds to relMSE 0.01 and 0.001, how many times faster than the first it is, bias.
std::string chart_table(const Chart& chart);

}  // namespace tyndall
