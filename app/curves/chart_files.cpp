#include "app/curves/chart_files.h"

#include "app/curves/svg.h"
#include "app/files/outputs.h"

namespace tyndall {

std::filesystem::path csv_beside(std::filesystem::path svg) { return svg.replace_extension(".csv"); }

void write_chart(const Chart& chart, const std::filesystem::path& svg) {
  write_text_file(csv_beside(svg), chart_csv(chart));
  write_text_file(svg, chart_svg(chart));
}

}  // namespace tyndall
