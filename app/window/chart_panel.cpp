#include "app/window/imgui_compat.h"
#include "app/window/panels.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

/// The live chart: estimated relMSE over seconds of rendering, both logarithmic, drawn with the draw list only.
namespace tyndall {
namespace {

constexpr double target = 1e-4;  ///< relMSE of 1 % relative error

/// Whole decades that hold all curves and the target.
struct Decades {
  int x0 = -1, x1 = 1, y0 = -4, y1 = 0;
};

Decades decades_of(const Convergence& runs) {
  Decades d;
  double first = 1e300, last = 0, least = target, most = target;
  const auto add = [&](const ConvergenceRun& run) {
    for (const ConvergencePoint& p : run.points) {
      first = std::min(first, p.seconds), last = std::max(last, p.seconds);
      least = std::min(least, p.rel_mse), most = std::max(most, p.rel_mse);
    }
  };
  add(runs.current());
  for (const ConvergenceRun& run : runs.earlier()) add(run);
  const auto below = [](double v) { return static_cast<int>(std::floor(std::log10(v))); };
  const auto above_of = [](double v) { return static_cast<int>(std::ceil(std::log10(v))); };
  if (last > 0) d.x0 = std::max(below(first), -3), d.x1 = std::max(above_of(last), d.x0 + 2);
  d.y0 = std::min(below(least * 0.7), -5), d.y1 = std::max(above_of(most), d.y0 + 3);
  return d;
}

/// Where the chart is on the screen.
struct Plot {
  ImDrawList* draw;
  const Ui& ui;
  Decades decades;
  Rect frame;

  float x(double seconds) const {
    const double t = (std::log10(seconds) - decades.x0) / (decades.x1 - decades.x0);
    return frame.x0 + static_cast<float>(t) * frame.width();
  }
  float y(double rel_mse) const {
    const double t = (std::log10(rel_mse) - decades.y0) / (decades.y1 - decades.y0);
    return frame.y1 - static_cast<float>(t) * frame.height();
  }
  void text(ImVec2 at, ImU32 colour, const std::string& words) const { draw->AddText(at, colour, words.c_str()); }
};

std::string decade_text(int exponent, const char* unit) {
  char text[32];
  if (exponent >= -2 && exponent <= 3)
    std::snprintf(text, sizeof text, "%g%s", std::pow(10.0, exponent), unit);
  else
    std::snprintf(text, sizeof text, "1e%d%s", exponent, unit);
  return text;
}

void draw_grid(const Plot& plot) {
  const Rect& f = plot.frame;
  const float line = ImGui::GetFontSize();
  const int every = plot.decades.y1 - plot.decades.y0 > 5 ? 2 : 1;
  for (int e = plot.decades.y0; e <= plot.decades.y1; ++e) {
    const float y = plot.y(std::pow(10.0, e));
    plot.draw->AddLine({f.x0, y}, {f.x1, y}, shade(palette::line));
    if ((e - plot.decades.y0) % every != 0) continue;
    const std::string text = decade_text(e, "");
    plot.text({f.x0 - ImGui::CalcTextSize(text.c_str()).x - 6 * plot.ui.scale, y - line / 2}, shade(palette::dim),
              text);
  }
  for (int e = plot.decades.x0; e <= plot.decades.x1; ++e) {
    const float x = plot.x(std::pow(10.0, e));
    plot.draw->AddLine({x, f.y0}, {x, f.y1}, shade(palette::line));
    const std::string text = decade_text(e, " s");
    const float width = ImGui::CalcTextSize(text.c_str()).x;
    plot.text({std::min(x - width / 2, f.x1 + 8 * plot.ui.scale - width), f.y1 + 4 * plot.ui.scale},
              shade(palette::dim), text);
  }
}

/// The target, and through the newest point the line that the error follows if nothing is wrong.
void draw_guides(const Plot& plot, const ConvergenceRun& run) {
  const Rect& f = plot.frame;
  const float y = plot.y(target);
  plot.draw->AddLine({f.x0, y}, {f.x1, y}, shade(palette::blue, 0.35f));
  plot.text({f.x0 + 5 * plot.ui.scale, y - ImGui::GetFontSize() - 1}, shade(palette::blue, 0.9f), "1 % error");
  if (run.points.empty()) return;
  const ConvergencePoint last = run.points.back();
  const auto at = [&](double seconds) {
    return ImVec2{plot.x(seconds), plot.y(last.rel_mse * last.seconds / seconds)};
  };
  const ImVec2 a = at(last.seconds), b = at(std::pow(10.0, plot.decades.x1 + 1));
  const float length = std::hypot(b.x - a.x, b.y - a.y), dash = 4 * plot.ui.scale;
  for (float s = 0; s < length; s += 2 * dash) {
    const float t0 = s / length, t1 = std::min(s + dash, length) / length;
    plot.draw->AddLine({a.x + t0 * (b.x - a.x), a.y + t0 * (b.y - a.y)},
                       {a.x + t1 * (b.x - a.x), a.y + t1 * (b.y - a.y)}, shade(palette::blue, 0.45f));
  }
}

void draw_curve(const Plot& plot, const ConvergenceRun& run, ImU32 colour, float width) {
  std::vector<ImVec2> points;
  for (const ConvergencePoint& p : run.points) points.push_back({plot.x(p.seconds), plot.y(p.rel_mse)});
  if (points.size() > 1) plot.draw->AddPolyline(points.data(), static_cast<int>(points.size()), colour, 0, width);
}

/// A curve's name beneath its end, where a falling curve leaves room, off the names before it.
void draw_name(const Plot& plot, const ConvergenceRun& run, const std::string& name, ImU32 colour,
               std::vector<float>& used) {
  if (run.points.empty()) return;
  const float line = ImGui::GetFontSize(), s = plot.ui.scale;
  const ConvergencePoint& last = run.points.back();
  const float width = ImGui::CalcTextSize(name.c_str()).x;
  const float x = std::clamp(plot.x(last.seconds) - width - 2 * s, plot.frame.x0 + 4 * s, plot.frame.x1 - width);
  float y = plot.y(last.rel_mse) + 5 * s;
  for (int tries = 0; tries < 4; ++tries)
    for (const float other : used)
      if (std::abs(other - y) < line) y = other + line;
  if (y + line > plot.frame.y1) return;
  used.push_back(y);
  plot.text({x, y}, colour, name);
}

void draw_runs(const Plot& plot, const Convergence& runs) {
  const Rect& f = plot.frame;
  const float s = plot.ui.scale;
  plot.draw->PushClipRect({f.x0, f.y0}, {f.x1, f.y1}, true);
  draw_guides(plot, runs.current());
  std::vector<float> used;
  for (const ConvergenceRun& run : runs.earlier()) draw_curve(plot, run, shade(palette::dim, 0.7f), 1.5f * s);
  draw_curve(plot, runs.current(), shade(palette::blue), 2.5f * s);
  draw_name(plot, runs.current(), runs.current().method, shade(palette::blue), used);
  for (const ConvergenceRun& run : runs.earlier())
    if (run.method != runs.current().method) draw_name(plot, run, run.method, shade(palette::dim), used);
  plot.draw->PopClipRect();
  if (!runs.current().points.empty()) {
    const ConvergencePoint last = runs.current().points.back();
    plot.draw->AddCircleFilled({plot.x(last.seconds), plot.y(last.rel_mse)}, 4 * s, shade(palette::blue));
  }
}

/// What is under the mouse, in numbers.
void read_out(Ui& ui, const Plot& plot) {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  if (!ImGui::IsItemHovered() || !plot.frame.contains(mouse.x, mouse.y)) return;
  const double tx = static_cast<double>((mouse.x - plot.frame.x0) / plot.frame.width());
  const double ty = static_cast<double>((plot.frame.y1 - mouse.y) / plot.frame.height());
  const double seconds = std::pow(10.0, plot.decades.x0 + tx * (plot.decades.x1 - plot.decades.x0));
  const double rel_mse = std::pow(10.0, plot.decades.y0 + ty * (plot.decades.y1 - plot.decades.y0));
  compat::push_font(ui.fonts.small);
  ImGui::SetTooltip("%.2g s: relMSE %.2g, error %.2g %%", seconds, rel_mse, 100 * std::sqrt(rel_mse));
  ImGui::PopFont();
}

}  // namespace

void chart_panel(Ui& ui, const PanelState& state, float height) {
  if (!section(ui, "Speed and accuracy", "estimated relMSE over time")) return;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetWindowContentRegionMax().x - ImGui::GetCursorPosX(), s = ui.scale;
  if (width < 80 * s) return;
  ImGui::InvisibleButton("chart", {width, height});
  log_item(ui, "chart", state.convergence->current().method);
  compat::push_font(ui.fonts.small);
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled(at, {at.x + width, at.y + height}, shade(palette::ink), 6 * s);
  const Plot plot{draw,
                  ui,
                  decades_of(*state.convergence),
                  {at.x + 38 * s, at.y + 10 * s, at.x + width - 14 * s, at.y + height - 22 * s}};
  draw_grid(plot);
  draw_runs(plot, *state.convergence);
  ImGui::PopFont();
  read_out(ui, plot);
}

}  // namespace tyndall
