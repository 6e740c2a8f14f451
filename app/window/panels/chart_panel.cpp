#include "app/window/panels/chart_plot.h"
#include "app/window/panels/panels.h"
#include "app/window/system/imgui_compat.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

/// The live chart: relMSE over seconds of rendering, both logarithmic. It is drawn line by line, without a chart
/// library.
namespace tyndall {
namespace {

/// A curve as it is drawn.
struct ChartLine {
  const ErrorCurve* curve;
  std::string name;
  ImU32 colour;
  float width;  ///< in units of the design
};

ChartLine line_of(const NamedCurve& named) {
  switch (named.role) {
    case NamedCurve::Role::earlier:
      break;
    case NamedCurve::Role::kept:
      return {named.curve, named.name, shade(palette::amber), 2};
    case NamedCurve::Role::clean:
      return {named.curve, named.name, shade(palette::text), 2};
    case NamedCurve::Role::current:
      return {named.curve, named.name, shade(palette::blue), 2.5f};
  }
  return {named.curve, named.name, shade(palette::dim, 0.7f), 1.5f};
}

/// Where the chart is on the screen.
struct Plot {
  ImDrawList* draw;
  const Ui& ui;
  std::vector<ChartLine> lines;
  std::vector<const ErrorCurve*> curves;  ///< of the lines
  ChartAxes axes;

  Plot(const Ui& the_ui, const std::vector<NamedCurve>& named, const Rect& frame)
      : draw(ImGui::GetWindowDrawList()), ui(the_ui) {
    for (const NamedCurve& one : named) lines.push_back(line_of(one)), curves.push_back(one.curve);
    axes = axes_for(curves, frame);
  }
  ImVec2 at(const ErrorPoint& p) const { return {axes.x(p.seconds), axes.y(p.rel_mse)}; }
  void text(ImVec2 at, ImU32 colour, const std::string& words) const { draw->AddText(at, colour, words.c_str()); }
};

std::string decade_text(int exponent, const char* unit) {
  if (exponent >= -2 && exponent <= 3) return fmt::format("{:g}{}", std::pow(10.0, exponent), unit);
  return fmt::format("1e{}{}", exponent, unit);
}

void draw_grid(const Plot& plot) {
  const Rect& f = plot.axes.frame;
  const Decades &times = plot.axes.times, &errors = plot.axes.errors;
  const float line = ImGui::GetFontSize();
  const int every = errors.last - errors.first > 5 ? 2 : 1;
  for (int e = errors.first; e <= errors.last; ++e) {
    const float y = plot.axes.y(std::pow(10.0, e));
    plot.draw->AddLine({f.x0, y}, {f.x1, y}, shade(palette::line));
    if ((e - errors.first) % every != 0) continue;
    const std::string text = decade_text(e, "");
    plot.text({f.x0 - ImGui::CalcTextSize(text.c_str()).x - 6 * plot.ui.scale, y - line / 2}, shade(palette::dim),
              text);
  }
  for (int e = times.first; e <= times.last; ++e) {
    const float x = plot.axes.x(std::pow(10.0, e));
    plot.draw->AddLine({x, f.y0}, {x, f.y1}, shade(palette::line));
    const std::string text = decade_text(e, " s");
    const float width = ImGui::CalcTextSize(text.c_str()).x;
    plot.text({std::min(x - width / 2, f.x1 + 8 * plot.ui.scale - width), f.y1 + 4 * plot.ui.scale},
              shade(palette::dim), text);
  }
}

/// The target of 1 %, and from the newest point on the line along which relMSE halves when the time doubles.
void draw_guides(const Plot& plot, const ErrorCurve& curve) {
  const Rect& f = plot.axes.frame;
  const float y = plot.axes.y(target_rel_mse);
  plot.draw->AddLine({f.x0, y}, {f.x1, y}, shade(palette::blue, 0.35f));
  plot.text({f.x0 + 5 * plot.ui.scale, y - ImGui::GetFontSize() - 1}, shade(palette::blue, 0.9f), "1 % error");
  if (curve.points.empty()) return;
  const ErrorPoint last = curve.points.back();
  const double end = 10 * plot.axes.times.most();
  const ImVec2 a = plot.at(last), b = plot.at({end, last.rel_mse * last.seconds / end});
  const float length = std::hypot(b.x - a.x, b.y - a.y), dash = 4 * plot.ui.scale;
  for (float s = 0; s < length; s += 2 * dash) {
    const float t0 = s / length, t1 = std::min(s + dash, length) / length;
    plot.draw->AddLine({a.x + t0 * (b.x - a.x), a.y + t0 * (b.y - a.y)},
                       {a.x + t1 * (b.x - a.x), a.y + t1 * (b.y - a.y)}, shade(palette::blue, 0.45f));
  }
}

void draw_curve(const Plot& plot, const ChartLine& line) {
  std::vector<ImVec2> points;
  for (const ErrorPoint& p : line.curve->points) points.push_back(plot.at(p));
  if (points.size() > 1)
    plot.draw->AddPolyline(points.data(), static_cast<int>(points.size()), line.colour, 0, line.width * plot.ui.scale);
}

/// Where a name of that size can stand near the end of its curve without covering curves or other words: beneath it,
/// where a falling curve leaves room, else above. Nothing where there is no room.
std::optional<Rect> place_of_name(const Plot& plot, ImVec2 end, float width, const std::vector<Rect>& words) {
  const Rect& f = plot.axes.frame;
  const float line = ImGui::GetFontSize(), s = plot.ui.scale;
  const auto free = [&](const Rect& at) {
    const auto overlaps = [&](const Rect& w) { return at.x0 < w.x1 && at.x1 > w.x0 && at.y0 < w.y1 && at.y1 > w.y0; };
    return at.y0 >= f.y0 && at.y1 <= f.y1 && std::none_of(words.begin(), words.end(), overlaps) &&
           !any_crosses(plot.curves, plot.axes, at);
  };
  const float right = std::max(f.x0 + 4 * s + width, std::min(end.x - 2 * s, f.x1));
  constexpr float steps[] = {0, 1, 2, -1, -2, -3, 3, 4};  // lines beneath the end
  for (const float left_by : {0.0f, 0.5f, 1.0f})
    for (const float step : steps) {
      const float x = std::max(f.x0 + 4 * s, right - width * (1 + left_by));
      const float y = step < 0 ? end.y - 5 * s + step * line : end.y + 5 * s + step * line;
      const Rect at{x, y, x + width, y + line};
      if (free(at)) return at;
    }
  return {};
}

void draw_name(const Plot& plot, const ChartLine& curve, std::vector<Rect>& words) {
  if (curve.curve->points.empty()) return;
  const ImVec2 end = plot.at(curve.curve->points.back());
  const auto at = place_of_name(plot, end, ImGui::CalcTextSize(curve.name.c_str()).x, words);
  if (!at) return;
  words.push_back(*at);
  plot.text({at->x0, at->y0}, curve.colour, curve.name);
}

void draw_lines(const Plot& plot) {
  const Rect& f = plot.axes.frame;
  const ErrorCurve& current = *plot.curves.back();
  plot.draw->PushClipRect({f.x0, f.y0}, {f.x1, f.y1}, true);
  draw_guides(plot, current);
  for (const ChartLine& line : plot.lines) draw_curve(plot, line);
  const float target = plot.axes.y(target_rel_mse);
  std::vector<Rect> words{{f.x0, target - ImGui::GetFontSize() - 1, f.x0 + 64 * plot.ui.scale, target - 1}};
  for (auto line = plot.lines.rbegin(); line != plot.lines.rend(); ++line) draw_name(plot, *line, words);
  plot.draw->PopClipRect();
  if (!current.points.empty())
    plot.draw->AddCircleFilled(plot.at(current.points.back()), 4 * plot.ui.scale, shade(palette::blue));
}

/// Marks the point of the curve nearest to the mouse, and shows its numbers in a tooltip.
void read_out(Ui& ui, const Plot& plot) {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  if (!ImGui::IsItemHovered() || !plot.axes.frame.contains(mouse.x, mouse.y)) return;
  const auto found = nearest_curve(plot.curves, plot.axes, mouse.x, mouse.y, 14 * ui.scale);
  if (!found) return;
  const ChartLine& line = plot.lines[found->curve];
  const ErrorPoint& p = found->at;
  plot.draw->AddCircleFilled(plot.at(p), 4.5f * ui.scale, shade(palette::ink));
  plot.draw->AddCircle(plot.at(p), 4.5f * ui.scale, shade(palette::text), 0, 1.5f * ui.scale);
  const std::string numbers = fmt::format("{:.2g} s, ", p.seconds) + format_count(p.spp) + " spp\nrelMSE " +
                              fmt::format("{:.2g}", p.rel_mse) + ", error " +
                              fmt::format("{:.2g} %", 100 * std::sqrt(p.rel_mse));
  compat::push_font(ui.fonts.small);
  ImGui::BeginTooltip();
  ImGui::TextUnformatted(line.name.c_str());
  ImGui::TextColored(palette::dim, "%s", numbers.c_str());
  ImGui::EndTooltip();
  ImGui::PopFont();
  if (ui.log)
    ui.log->changed("reading",
                    line.name + ": " + fmt::format("{:.4g} s ", p.seconds) + fmt::format("{:.4g}", p.rel_mse));
}

void draw_chart(Ui& ui, const PanelState& state, ImVec2 size) {
  const float s = ui.scale;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton("chart", {std::max(size.x, 1.0f), std::max(size.y, 1.0f)});  // ImGui ends at nothing
  const LiveAccuracy& accuracy = *state.facts.accuracy;
  log_item(ui, "chart", accuracy.curves(Half::current).current().method);
  compat::push_font(ui.fonts.small);
  ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + size.x, at.y + size.y}, shade(palette::ink), 6 * s);
  const Rect frame{at.x + 38 * s, at.y + 10 * s, at.x + size.x - 14 * s, at.y + size.y - 22 * s};
  const Plot plot(ui, accuracy.named_curves(), frame);
  draw_grid(plot);
  draw_lines(plot);
  ImGui::PopFont();
  read_out(ui, plot);
}

}  // namespace

void chart_panel(Ui& ui, PanelState& state, float height) {
  const char* about = state.facts.accuracy->is_true() ? "true relMSE over time" : "estimated relMSE over time";
  if (!section(ui, "Speed and accuracy", about)) return;
  const float width = ImGui::GetWindowContentRegionMax().x - ImGui::GetCursorPosX();
  if (width < 80 * ui.scale) return;
  draw_chart(ui, state, {width, height});
  std::string all;
  for (const AccuracyLine& line : accuracy_lines(*state.facts.accuracy)) {
    line_of_note(ui, line.text, line.warning ? palette::amber : palette::dim);
    all += (all.empty() ? "" : " | ") + line.text;
  }
  if (ui.log) ui.log->changed("accuracy", all);
  if (small_button(ui, "chart.reference", "Reference…")) state.wishes.reference = true;
  tooltip(ui, "an image to measure the true error against");
  ImGui::SameLine();
  if (small_button(ui, "chart.export", "Export CSV, SVG")) state.wishes.export_chart = true;
  tooltip(ui, "the curves, as numbered files in the current folder");
}

}  // namespace tyndall
