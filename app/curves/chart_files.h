#pragma once
#include "app/curves/chart.h"

#include <filesystem>

/// The two files of a chart: its drawing, and a table of the same numbers beside it.
namespace tyndall {

/// The table that is written beside a chart: the same name, ending in .csv.
std::filesystem::path csv_beside(std::filesystem::path svg);

/// Writes the table and the drawing. svg: name of the drawing. Throws ImageFileError if one of them cannot be written.
void write_chart(const Chart& chart, const std::filesystem::path& svg);

}  // namespace tyndall
