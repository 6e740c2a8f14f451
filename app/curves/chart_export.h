#pragma once
#include "app/curves/convergence.h"
#include "app/curves/svg.h"

#include <filesystem>
#include <string>
#include <vector>

namespace tyndall {

/// The live chart as the chart's files want it; runs without points are left out.
Chart live_chart(const std::vector<NamedRun>& runs, const std::string& title, const std::string& subtitle);

/// Writes BASE.csv and BASE.svg. Returns what to tell the user. Throws ImageFileError.
std::string write_chart(const Chart& chart, const std::filesystem::path& base);

}  // namespace tyndall
