#pragma once
#include "app/curves/curve.h"

#include <string>
#include <vector>

/// Charts in numbers and words: their points as CSV, and what a comparison of the methods says.
namespace tyndall {

/// Curves and what is said of them, for files and for the table that the command `chart` prints.
struct Chart {
  std::string title, subtitle;
  std::vector<ErrorCurve> curves;
  double reference_noise = 0;  ///< relMSE of what errors were measured against; 0: not known
};

/// What a curve's floor is called: "bias", or "floor" where it may as well be the reference's unknown noise.
const char* floor_name(const Chart& chart);

/// A line method,spp,seconds,relmse for each point, below a line with these names.
std::string chart_csv(const Chart& chart);

/// For each method: seconds to relMSE 0.01 and 0.001, how many times faster than the first method it is, and its bias.
std::string chart_table(const Chart& chart);

}  // namespace tyndall
