#include "app/curves/chart_files.h"

#include "app/curves/svg.h"
#include "app/files/outputs.h"

namespace tyndall {

std::filesystem::path csv_beside(std::filesystem::path svg) { return svg.replace_extension(".csv"); }

void write_chart(const Chart& chart, const std::filesystem::path& svg) {
  std::string problem;
  const auto write = [&problem](const std::filesystem::path& file, const std::string& text) {
    try {
      write_text_or_rescue(file, text);
    } catch (const ImageFileError& error) {
      problem += (problem.empty() ? "" : "; ") + std::string(error.what());
    }
  };
  write(csv_beside(svg), chart_csv(chart));
  write(svg, chart_svg(chart));
  if (!problem.empty()) throw ImageFileError(problem);
}

}  // namespace tyndall
