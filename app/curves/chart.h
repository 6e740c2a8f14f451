#pragma once
#include "app/curves/curve.h"

#include <filesystem>
#include <string>
#include <vector>

/// Charts in numbers, words and drawings: their points as CSV, what a comparison of the methods says, and both files.
namespace tyndall {

/// Curves and what is said of them, for files and for the table that the command `chart` prints.
struct Chart {
  std::string title, subtitle;
  std::vector<ErrorCurve> curves;
  double reference_noise = 0;  ///< relMSE of what errors were measured against; 0: not known
};

/// A line method,spp,seconds,relmse for each point, below a line with these names.
std::string chart_csv(const Chart& chart);

/// For each method: seconds to relMSE 0.01 and 0.001, how many times faster than the first method it is, and its bias.
std::string chart_table(const Chart& chart);

/// A drawing of seconds against relMSE on logarithmic axes, as SVG. Each curve is named at its end, a guide shows the
/// slope -1 that more samples alone give, floors are dashed. The colours are those of Okabe and Ito (Color Universal
/// Design, 2008), for light and dark pages.
std::string chart_svg(const Chart& chart);

/// The table that is written beside a chart: the same name, ending in .csv.
std::filesystem::path csv_beside(std::filesystem::path svg);

/// Writes the table and the drawing. svg: name of the drawing. Throws ImageFileError if one of them cannot be written.
void write_chart(const Chart& chart, const std::filesystem::path& svg);

}  // namespace tyndall
