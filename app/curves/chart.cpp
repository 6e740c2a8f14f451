#include "app/curves/chart.h"

#include "app/files/outputs.h"
#include "core/base/text.h"

#include <fmt/core.h>

#include <algorithm>
#include <optional>

namespace tyndall {
namespace {

/// A name as one field of CSV.
std::string csv_field(const std::string& name) {
  if (name.find_first_of(",\"\r\n") == std::string::npos) return name;
  std::string quoted = "\"";
  for (const char c : name) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

}  // namespace

const char* floor_name(const Chart& chart) { return chart.reference_noise > 0 ? "bias" : "floor"; }

std::string chart_csv(const Chart& chart) {
  std::string out = "method,spp,seconds,relmse\n";
  for (const ErrorCurve& curve : chart.curves)
    for (const ErrorPoint& p : curve.points)
      out += csv_field(curve.method) + fmt::format(",{},{:.6g},{:.6g}\n", p.spp, p.seconds, p.rel_mse);
  return out;
}

std::string chart_table(const Chart& chart) {
  const auto time = [](const ErrorCurve& curve, double error) {
    const auto seconds = seconds_to(curve, error);
    return seconds ? fmt::format("{:.3g} s", *seconds) : std::string("-");
  };
  std::size_t longest = 6;
  for (const ErrorCurve& curve : chart.curves) longest = std::max(longest, printable(curve.method).size());
  const auto padded = [](std::string text, std::size_t to) {
    return text += std::string(to - std::min(to, text.size()), ' ');
  };
  std::string out = padded("method", longest + 2) + "to 0.01    to 0.001   speed     " + floor_name(chart) + "\n";
  const ErrorCurve* first = chart.curves.empty() ? nullptr : &chart.curves.front();
  for (const ErrorCurve& curve : chart.curves) {
    const auto bias = bias_of(curve, chart.reference_noise);
    const auto speed = bias ? std::nullopt : speed_against(*first, curve);
    out += padded(printable(curve.method), longest + 2) + padded(time(curve, 0.01), 11) +
           padded(time(curve, 0.001), 11) + padded(speed ? fmt::format("{:.3g}x", *speed) : "-", 10) +
           (bias ? fmt::format("{:.2g}", *bias) : std::string("none seen")) + "\n";
  }
  return out;
}

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
