#pragma once
#include "app/curves/chart.h"

#include <string>

/// Charts as SVG files.
namespace tyndall {

/// A drawing of seconds against relMSE on logarithmic axes. Each curve is named at its end, a guide shows the slope -1
/// that more samples alone give, floors are dashed. The colours are those of Okabe and Ito (Color Universal Design,
/// 2008), for light and dark pages.
std::string chart_svg(const Chart& chart);

}  // namespace tyndall
