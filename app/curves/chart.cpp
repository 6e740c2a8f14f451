#include "app/curves/chart.h"

#include "app/files/outputs.h"
#include "app/text/markup.h"
#include "core/base/text.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace tyndall {
namespace {

/// Of the page, and its margins; as assets/templates/chart.svg has them.
constexpr double width = 960, height = 600, left = 78, right = 230, top = 64, bottom = 62;
constexpr std::size_t colours = 8;

std::string text_at(double x, double y, const std::string& attributes, const std::string& words) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" ", x, y) + attributes + ">" + in_xml(words) + "</text>\n";
}
std::string line(double x0, double y0, double x1, double y1, const std::string& kind) {
  return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" class=\"{}\"/>\n", x0, y0, x1, y1,
                     kind.c_str());
}

/// The range of the axes, in whole decades that hold all points, and where times and errors are on the page.
struct Plot {
  Decades seconds{0, 1}, errors{-3, 0};

  explicit Plot(const std::vector<ErrorCurve>& curves) {
    double first = 1e300, last = 0, minimum = 1e-2, maximum = 1e-1;
    for (const ErrorCurve& curve : curves)
      for (const ErrorPoint& p : curve.points) {
        first = std::min(first, p.seconds), last = std::max(last, p.seconds);
        if (p.rel_mse > 0) minimum = std::min(minimum, p.rel_mse), maximum = std::max(maximum, p.rel_mse);
      }
    if (last <= 0) return;
    seconds = decades_around(first, last, 1);
    errors = decades_around(minimum, maximum, 1);
  }
  double x(double time) const { return left + seconds.part_of(time) * (width - left - right); }
  double y(double error) const { return height - bottom - errors.part_of(error) * (height - top - bottom); }
};

std::string grid(const Plot& plot) {
  std::string out;
  for (int e = plot.seconds.first; e <= plot.seconds.last; ++e) {
    for (int m = 2; m < 10 && e < plot.seconds.last; ++m)
      out += line(plot.x(m * std::pow(10.0, e)), top, plot.x(m * std::pow(10.0, e)), height - bottom, "minor");
    const double x = plot.x(std::pow(10.0, e));
    out += line(x, top, x, height - bottom, "grid");
    out += text_at(x, height - bottom + 20, "text-anchor=\"middle\"",
                   fmt::format("{:g} {}", std::pow(10.0, e < 0 ? e + 3 : e), e < 0 ? "ms" : "s"));
  }
  for (int e = plot.errors.first; e <= plot.errors.last; ++e) {
    const double y = plot.y(std::pow(10.0, e));
    out += line(left, y, width - right, y, "grid");
    out += text_at(left - 8, y + 4, "text-anchor=\"end\"", fmt::format("{:g}", std::pow(10.0, e)));
  }
  return out;
}

/// A line of slope -1: along it the error halves when the time doubles, which is what more samples alone give.
std::string slope_guide(const Plot& plot, const std::vector<ErrorCurve>& curves) {
  double best = 1e300;
  for (const ErrorCurve& curve : curves)
    for (const ErrorPoint& p : curve.points)
      if (p.rel_mse > 0) best = std::min(best, p.rel_mse * p.seconds);
  if (best > 1e299) return "";
  best *= 0.6;
  const double from = std::max(best / plot.errors.maximum(), plot.seconds.minimum()),
               to = std::min(best / plot.errors.minimum(), plot.seconds.maximum());
  if (from >= to) return "";
  const double x = plot.x(from), y = plot.y(best / from);
  return line(x, y, plot.x(to), plot.y(best / to), "guide") + text_at(x + 6, y + 14, "class=\"dim\"", "slope -1");
}

std::string curve_lines(const Plot& plot, const Chart& chart, std::size_t i) {
  const ErrorCurve& curve = chart.curves[i];
  std::string points, dots;
  for (const ErrorPoint& p : curve.points) {
    if (!(p.rel_mse > 0)) continue;
    points += fmt::format("{:.1f},{:.1f} ", plot.x(p.seconds), plot.y(p.rel_mse));
    dots += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.6\" class=\"f{}\"/>\n", plot.x(p.seconds),
                        plot.y(p.rel_mse), i % colours);
  }
  std::string out = fmt::format("<polyline class=\"curve s{}{}\" points=\"", i % colours, i < colours ? "" : " again") +
                    points + "\"/>\n" + dots;
  if (const auto bias = bias_of(curve, chart.reference_noise))
    out += line(left, plot.y(*bias), width - right, plot.y(*bias), fmt::format("bias s{}", i % colours));
  return out;
}

/// What a curve's floor is called: "bias", or "floor" where it may as well be the reference's unknown noise.
const char* floor_name(const Chart& chart) { return chart.reference_noise > 0 ? "bias" : "floor"; }

/// The curves' names in the right margin, each as near to the height of its curve's end as the others leave room.
std::string names(const Plot& plot, const Chart& chart) {
  constexpr double apart = 17;
  std::vector<std::pair<double, std::size_t>> ends;  // their heights, and the curves
  for (std::size_t i = 0; i < chart.curves.size(); ++i) {
    const auto& points = chart.curves[i].points;
    if (!points.empty() && points.back().rel_mse > 0) ends.emplace_back(plot.y(points.back().rel_mse), i);
  }
  std::sort(ends.begin(), ends.end());
  double next = top + 4, latest = height - bottom - static_cast<double>(ends.size()) * apart;
  std::string out;
  for (const auto& [at, i] : ends) {
    latest += apart;
    const double y = std::min(std::max(at, next), latest);
    next = y + apart;
    const ErrorCurve& curve = chart.curves[i];
    const ErrorPoint& end = curve.points.back();
    const std::size_t colour = i % colours;
    out += fmt::format("<polyline class=\"lead s{}\" points=\"{:.1f},{:.1f} {:.1f},{:.1f} {:.1f},{:.1f}\"/>\n", colour,
                       plot.x(end.seconds) + 5, plot.y(end.rel_mse), width - right + 4, y, width - right + 12, y);
    const auto bias = bias_of(curve, chart.reference_noise);
    out += text_at(width - right + 16, y + 4, fmt::format("class=\"f{}\"", colour),
                   curve.method + (bias ? fmt::format(" ({} {:.2g})", floor_name(chart), *bias) : ""));
  }
  return out;
}

}  // namespace

std::string chart_csv(const Chart& chart) {
  std::string out = "method,spp,seconds,relmse\n";
  for (const ErrorCurve& curve : chart.curves)
    for (const ErrorPoint& p : curve.points)
      out += in_csv(curve.method) + fmt::format(",{},{:.6g},{:.6g}\n", p.spp, p.seconds, p.rel_mse);
  return out;
}

std::string chart_table(const Chart& chart) {
  const auto time = [](const ErrorCurve& curve, double error) {
    const auto seconds = seconds_to(curve, error);
    return seconds ? fmt::format("{:.3g} s", *seconds) : std::string("-");
  };
  std::size_t longest = 6;
  for (const ErrorCurve& curve : chart.curves) longest = std::max(longest, printable(curve.method).size());
  const auto row = [](const auto&... cells) { return fmt::format("{:<{}}{:<11}{:<11}{:<10}{}\n", cells...); };
  std::string out = row("method", longest + 2, "to 0.01", "to 0.001", "speed", floor_name(chart));
  for (const ErrorCurve& curve : chart.curves) {
    const auto bias = bias_of(curve, chart.reference_noise);
    const auto speed = bias ? std::nullopt : speed_against(chart.curves.front(), curve);
    out += row(printable(curve.method), longest + 2, time(curve, 0.01), time(curve, 0.001),
               speed ? fmt::format("{:.3g}x", *speed) : "-", bias ? fmt::format("{:.2g}", *bias) : "none seen");
  }
  return out;
}

void write_chart(const Chart& chart, const std::filesystem::path& svg) {
  std::string problem;
  for (const auto& [file, text] : {std::pair(csv_beside(svg), chart_csv(chart)), std::pair(svg, chart_svg(chart))})
    try {
      write_text_or_rescue(file, text);
    } catch (const ImageFileError& error) {
      problem += (problem.empty() ? "" : "; ") + std::string(error.what());
    }
  if (!problem.empty()) throw ImageFileError(problem);
}

std::string chart_svg(const Chart& chart) {
  const Plot plot(chart.curves);
  std::string curves = slope_guide(plot, chart.curves);
  for (std::size_t i = 0; i < chart.curves.size(); ++i) curves += curve_lines(plot, chart, i);
  const std::string title = in_xml(chart.title);
  return from_template("chart.svg", {{"title", title},
                                     {"title", title},
                                     {"subtitle", in_xml(chart.subtitle)},
                                     {"grid", grid(plot)},
                                     {"curves", curves + names(plot, chart)}});
}

}  // namespace tyndall
