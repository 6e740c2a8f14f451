#include "app/window/panels/panels.h"

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

/// Of the curves of earlier edits, each in a hue of its own.
constexpr ThemeTone earlier_tones[Convergence::max_earlier]{{{0.50f, 0.72f, 0.52f, 1}, {0.20f, 0.47f, 0.23f, 1}},
                                                            {{0.68f, 0.58f, 0.84f, 1}, {0.42f, 0.30f, 0.62f, 1}},
                                                            {{0.82f, 0.51f, 0.62f, 1}, {0.62f, 0.25f, 0.38f, 1}},
                                                            {{0.68f, 0.66f, 0.42f, 1}, {0.43f, 0.41f, 0.12f, 1}}};

/// How a named curve is drawn. index: among all of them, of which the earlier ones come first.
ChartLine line_of(const NamedCurve& named, std::size_t index) {
  using Role = NamedCurve::Role;
  if (named.role == Role::earlier)
    return {named.curve, named.name, shade(earlier_tones[index % std::size(earlier_tones)], 0.8f), 1.5f};
  const Tone tone = named.role == Role::kept    ? palette::amber
                    : named.role == Role::clean ? palette::text
                                                : palette::blue;
  return {named.curve, named.name, shade(tone), named.role == Role::current ? 2.5f : 2.0f};
}

ImU32 target_colour() { return shade(palette::blue, 0.4f); }

/// Where the chart is on the screen.
struct Plot {
  ImDrawList* draw;
  const Ui& ui;
  std::vector<ChartLine> lines;
  std::vector<const ErrorCurve*> curves;  ///< of the lines
  ChartAxes axes;

  Plot(const Ui& the_ui, std::vector<ChartLine> the_lines, const Rect& frame)
      : draw(ImGui::GetWindowDrawList()), ui(the_ui), lines(std::move(the_lines)) {
    for (const ChartLine& line : lines) curves.push_back(line.curve);
    axes = axes_for(curves, frame);
  }
  ImVec2 at(const ErrorPoint& p) const { return {axes.x(p.seconds), axes.y(p.rel_mse)}; }
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
    const float width = ImGui::CalcTextSize(text.c_str()).x;
    plot.draw->AddText({f.x0 - width - 6 * plot.ui.scale, y - line / 2}, shade(palette::dim), text.c_str());
  }
  for (int e = times.first; e <= times.last; ++e) {
    const float x = plot.axes.x(std::pow(10.0, e));
    plot.draw->AddLine({x, f.y0}, {x, f.y1}, shade(palette::line));
    const std::string text = decade_text(e, " s");
    const float width = ImGui::CalcTextSize(text.c_str()).x;
    const float left = std::min(x - width / 2, f.x1 + 8 * plot.ui.scale - width);
    plot.draw->AddText({left, f.y1 + 4 * plot.ui.scale}, shade(palette::dim), text.c_str());
  }
}

/// The target of 1 %, and from the newest point on the line along which relMSE halves when the time doubles.
void draw_guides(const Plot& plot, const ErrorCurve& curve) {
  const Rect& f = plot.axes.frame;
  const float y = plot.axes.y(target_rel_mse);
  plot.draw->AddLine({f.x0, y}, {f.x1, y}, target_colour());
  if (curve.points.empty()) return;
  const ErrorPoint last = curve.points.back();
  const double end = 10 * plot.axes.times.maximum();
  const ImVec2 a = plot.at(last), b = plot.at({end, last.rel_mse * last.seconds / end});
  const float length = std::hypot(b.x - a.x, b.y - a.y), dash = 4 * plot.ui.scale;
  const auto point = [&](float s) { return ImLerp(a, b, std::min(s / length, 1.0f)); };
  for (float s = 0; s < length; s += 2 * dash)
    plot.draw->AddLine(point(s), point(s + dash), shade(palette::blue, 0.45f));
}

void draw_lines(const Plot& plot) {
  const Rect& f = plot.axes.frame;
  plot.draw->PushClipRect({f.x0, f.y0}, {f.x1, f.y1}, true);
  draw_guides(plot, *plot.curves.back());
  for (const ChartLine& line : plot.lines) {
    std::vector<ImVec2> points;
    for (const ErrorPoint& p : line.curve->points) points.push_back(plot.at(p));
    const auto count = static_cast<int>(points.size());
    if (count > 1) plot.draw->AddPolyline(points.data(), count, line.colour, 0, line.width * plot.ui.scale);
  }
  plot.draw->PopClipRect();
  for (const ChartLine& line : plot.lines)
    if (!line.curve->points.empty())
      plot.draw->AddCircleFilled(plot.at(line.curve->points.back()), 1.6f * line.width * plot.ui.scale, line.colour);
}

/// Names the lines of the chart beneath it, the current one first: nothing is written over the curves. The last names
/// stand above `bottom`. Returns where the first ones begin.
float draw_legend(const Ui& ui, std::vector<ChartLine> lines, float left, float right, float bottom) {
  const float s = ui.scale;
  std::erase_if(lines, [](const ChartLine& line) { return line.curve->points.empty(); });
  std::reverse(lines.begin(), lines.end());
  lines.push_back({nullptr, "1 % error", target_colour(), 1.5f});
  std::vector<float> widths;
  for (const ChartLine& line : lines) widths.push_back(ImGui::CalcTextSize(line.name.c_str()).x + 18 * s);
  const std::vector<Rect> places = rows_of_names(widths, {left, 0, right, ImGui::GetFontSize() + 2 * s}, 12 * s);
  const float top = bottom - places.back().y1;
  ImDrawList* draw = ImGui::GetWindowDrawList();
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const float x = places[i].x0, y = top + places[i].y0, middle = y + places[i].height() / 2;
    draw->AddLine({x, middle}, {x + 13 * s, middle}, lines[i].colour, lines[i].width * s);
    draw->AddText({x + 18 * s, y + s}, shade(palette::dim), lines[i].name.c_str());
  }
  return top;
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
  const std::string numbers = fmt::format("{:.2g} s, {} spp\nrelMSE {:.2g}, error {:.2g} %", p.seconds,
                                          format_count(p.spp), p.rel_mse, 100 * std::sqrt(p.rel_mse));
  const WithFont small(ui.fonts.small);
  ImGui::BeginTooltip();
  ImGui::TextUnformatted(line.name.c_str());
  ImGui::TextColored(palette::dim, "%s", numbers.c_str());
  ImGui::EndTooltip();
  if (ui.log) ui.log->changed("reading", fmt::format("{}: {:.4g} s {:.4g}", line.name, p.seconds, p.rel_mse));
}

void draw_chart(Ui& ui, const PanelState& state, ImVec2 size) {
  const float s = ui.scale;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton("chart", {std::max(size.x, 1.0f), std::max(size.y, 1.0f)});  // ImGui ends at nothing
  const LiveAccuracy& accuracy = *state.now.accuracy;
  log_item(ui, "chart", accuracy.curves(Half::current).current().method);
  const WithFont small(ui.fonts.small);
  const ImVec2 end{at.x + size.x, at.y + size.y};
  ImGui::GetWindowDrawList()->AddRectFilled(at, end, shade(palette::ink), 6 * s);
  std::vector<ChartLine> lines;
  for (const NamedCurve& one : accuracy.named_curves()) lines.push_back(line_of(one, lines.size()));
  ImGui::PushClipRect(at, end, true);
  const float foot = draw_legend(ui, lines, at.x + 10 * s, end.x - 10 * s, end.y - 6 * s);
  const Plot plot(ui, lines, {at.x + 38 * s, at.y + 10 * s, end.x - 14 * s, std::max(at.y + 40 * s, foot - 22 * s)});
  draw_grid(plot);
  draw_lines(plot);
  ImGui::PopClipRect();
  read_out(ui, plot);
}

std::string flip_text(const PairErrors& pair) {
  return pair.flip ? fmt::format(" · FLIP {:.2g}", *pair.flip) + " at " + format_count(pair.flip_spp) + " spp" : "";
}

AccuracyLine reference_line(const LiveAccuracy& accuracy) {
  const std::string& name = accuracy.reference()->about;
  const ReferenceFit fit = *accuracy.fit(Half::current);
  const bool same_numbers = fit == ReferenceFit::same_samples || accuracy.fit(Half::kept) == ReferenceFit::same_samples;
  if (fit == ReferenceFit::other_scene) return {"reference of another scene: " + name, true};
  if (fit == ReferenceFit::other_size) return {"reference of another size: " + name, true};
  if (same_numbers) return {"same random numbers, noise looks too small: " + name, true};
  return {"against " + name + (accuracy.split() ? "" : flip_text(accuracy.pair())), false};
}

}  // namespace

ChartAxes axes_for(std::span<const ErrorCurve* const> curves, const Rect& frame) {
  ChartAxes axes;
  axes.frame = frame;
  double first = 1e300, last = 0, minimum = target_rel_mse, maximum = target_rel_mse;
  for (const ErrorCurve* curve : curves)
    for (const ErrorPoint& p : curve->points) {
      first = std::min(first, p.seconds), last = std::max(last, p.seconds);
      minimum = std::min(minimum, p.rel_mse), maximum = std::max(maximum, p.rel_mse);
    }
  if (last > 0) axes.times = decades_around(std::max(first, 1e-3), last, 2);
  axes.errors = decades_around(std::min(minimum * 0.7, 1e-5), maximum, 3);
  return axes;
}

float ChartAxes::x(double seconds) const {
  return frame.x0 + static_cast<float>(times.part_of(seconds)) * frame.width();
}
float ChartAxes::y(double rel_mse) const {
  return frame.y1 - static_cast<float>(errors.part_of(rel_mse)) * frame.height();
}
double ChartAxes::seconds(float x) const { return times.value_at((x - frame.x0) / frame.width()); }
double ChartAxes::rel_mse(float y) const { return errors.value_at((frame.y1 - y) / frame.height()); }

std::optional<CurveReading> nearest_curve(std::span<const ErrorCurve* const> curves, const ChartAxes& axes, float x,
                                          float y, float reach) {
  std::optional<CurveReading> nearest;
  float minimum = 0;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const ErrorCurve& curve = *curves[i];
    if (curve.points.empty()) continue;
    const ErrorPoint &first = curve.points.front(), &last = curve.points.back();
    if (x < axes.x(first.seconds) - reach || x > axes.x(last.seconds) + reach) continue;
    const auto at = point_at(curve, std::clamp(axes.seconds(x), first.seconds, last.seconds));
    const float distance = std::abs(axes.y(at->rel_mse) - y);
    if (!nearest || distance < minimum) nearest = CurveReading{i, *at}, minimum = distance;
  }
  return nearest;
}

std::vector<Rect> rows_of_names(std::span<const float> widths, const Rect& first, float gap) {
  std::vector<Rect> rows;
  float x = first.x0, y = first.y0;
  for (const float width : widths) {
    if (x > first.x0 && x + width > first.x1) x = first.x0, y += first.height();
    rows.push_back({x, y, x + width, y + first.height()});
    x += width + gap;
  }
  return rows;
}

std::vector<AccuracyLine> accuracy_lines(const LiveAccuracy& accuracy) {
  std::vector<AccuracyLine> lines;
  if (accuracy.reference() && accuracy.fit(Half::current)) lines.push_back(reference_line(accuracy));
  if (!accuracy.split()) return lines;
  const PairErrors& pair = accuracy.pair();
  lines.push_back(
      {"B against A" + (pair.rel_mse ? fmt::format(": relMSE {:.2g}", *pair.rel_mse) : "") + flip_text(pair), false});
  return lines;
}

void chart_panel(Ui& ui, PanelState& state) {
  const char* about = state.now.accuracy->is_true() ? "true relMSE over time" : "estimated relMSE over time";
  if (!section(ui, "Speed and accuracy", about)) return;
  const float width = ImGui::GetWindowContentRegionMax().x - ImGui::GetCursorPosX();
  if (width < 80 * ui.scale) return;
  draw_chart(ui, state, {width, chart_height * ui.scale});
  std::string all;
  for (const AccuracyLine& line : accuracy_lines(*state.now.accuracy)) {
    line_of_note(ui, line.text, line.warning ? palette::amber : palette::dim);
    all += (all.empty() ? "" : " | ") + line.text;
  }
  if (ui.log) ui.log->changed("accuracy", all);
  if (small_button(ui, "chart.reference", "Reference…")) ui.requests.push_back({"reference picture"});
  tooltip(ui, "an image to measure the true error against");
  ImGui::SameLine();
  if (small_button(ui, "chart.export", "Export CSV, SVG")) ui.requests.push_back({"export the chart"});
  tooltip(ui, "the curves, as numbered files in the current folder");
}

}  // namespace tyndall
