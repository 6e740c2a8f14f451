#include "app/window/inspector/drawings.h"

#include "app/report/heat_map.h"
#include "app/window/picture/display.h"
#include "app/window/system/imgui_compat.h"
#include "app/window/tools/camera_control.h"
#include "core/base/text.h"
#include "core/image/tonemap.h"

#include <fmt/core.h>

#include <algorithm>

namespace tyndall {
namespace {

constexpr std::size_t max_told = 18;  // stops of a path

void draw_number(Ui& ui, ImDrawList& draw, ImVec2 at, std::size_t number, bool light) {
  const float s = ui.scale;
  draw.AddCircleFilled(at, 4 * s, shade(light ? palette::amber : palette::blue), 16);
  draw.AddCircle(at, 4.5f * s, shade(palette::ink, 0.8f), 16, s);
  const std::string text = std::to_string(number);
  const ImVec2 from{at.x + 7 * s, at.y - 7 * s};
  draw.AddText({from.x + s, from.y + s}, shade(palette::ink, 0.9f), text.c_str());
  draw.AddText(from, shade(palette::text), text.c_str());
}

constexpr int parts = 32;  // of a blended bar

/// A bar of colours for numbers from 0 to `white`.
template <class ColourOf>
Legend bar(const std::string& title, double white, const char* unit, const ColourOf& colour_of) {
  Legend legend{title, {}, false, {}};
  for (int k = 0; k <= parts; ++k) {
    std::array<float, 3> colour = colour_of(static_cast<float>(k) / parts);
    for (float& c : colour) c = srgb_encode(std::clamp(c, 0.0f, 1.0f));
    legend.colours.push_back(colour);
  }
  for (const double fraction : {0.0, 0.5, 1.0})
    legend.numbers.push_back(fmt::format("{:.3g}{}", fraction * white, unit));
  return legend;
}

Legend grey_bar(const std::string& title, double white, const char* unit = "") {
  return bar(title, white, unit, [](float v) { return std::array{v, v, v}; });
}

Legend legend_of_stops() {
  Legend legend{"stops from middle grey", {}, true, {}};
  for (const ScreenColour& c : stop_colours) legend.colours.push_back({c.r, c.g, c.b});
  for (int stop = darkest_stop; stop <= brightest_stop; ++stop) legend.numbers.push_back(fmt::format("{:+}", stop));
  legend.numbers[static_cast<std::size_t>(-darkest_stop)] = "0";
  return legend;
}

}  // namespace

ImVec2 in_window(const Rect& image, ImagePoint p) {
  const auto limited = [](double v) { return static_cast<float>(std::clamp(v, -20.0, 21.0)); };
  return {image.x0 + limited(p.x) * image.width(), image.y0 + limited(p.y) * image.height()};
}

std::vector<std::string> path_lines(const NoisyPath& found, const std::vector<PathStop>& stops) {
  std::vector<std::string> lines{fmt::format("path of sample {} of pixel {}, {}", found.sample, found.x, found.y),
                                 sentence_of(found)};
  for (std::size_t k = 0; k < stops.size(); ++k) {
    const bool left_out = stops.size() > max_told && k >= max_told - 1 && k + 1 < stops.size();
    if (left_out && k == max_told - 1) lines.push_back(fmt::format("    … {} more", stops.size() - max_told));
    if (!left_out) lines.push_back(fmt::format("{:>2}  {}", k + 1, stops[k].text));
  }
  return lines;
}

void draw_path(Ui& ui, const Scene& scene, const Rect& image, const Rect& visible, Vec3d eye,
               const std::vector<PathStop>& stops) {
  if (image.width() <= 0) return;
  const Projection projection(scene);
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  draw.PushClipRect({visible.x0, visible.y0}, {visible.x1, visible.y1}, true);
  compat::push_font(ui.fonts.small);
  std::vector<Vec3d> points;
  for (const PathStop& stop : stops) {
    const Vec3d from = stop.before < 0 ? eye : points[static_cast<std::size_t>(stop.before)];
    const Vec3d to = stop.away ? from + 2 * target_distance(scene.camera) * stop.point : stop.point;
    points.push_back(to);
    const auto line = projection.line(from, to);
    if (!line) continue;
    const ImVec2 a = in_window(image, line->a), b = in_window(image, line->b);
    draw.AddLine(a, b, shade(palette::ink, 0.7f), 4 * ui.scale);
    draw.AddLine(a, b, shade(stop.away ? palette::dim : palette::amber), 1.8f * ui.scale);
  }
  for (std::size_t k = 0; k < stops.size(); ++k) {
    const auto at = stops[k].away ? std::nullopt : projection.point(points[k]);
    if (!at) continue;
    const ImVec2 place = in_window(image, *at);
    draw_number(ui, draw, place, k + 1, stops[k].light);
    const float half = 4 * ui.scale;
    if (ui.log)
      ui.log->widget("path." + std::to_string(k + 1), {place.x - half, place.y - half, place.x + half, place.y + half},
                     stops[k].text);
  }
  ImGui::PopFont();
  draw.PopClipRect();
}

void draw_lines(Ui& ui, const Rect& visible, const std::vector<std::string>& lines,
                const std::array<float, 3>* swatch) {
  const float s = ui.scale, pad = 10 * s;
  compat::push_font(ui.fonts.mono);
  float width = 0;
  for (const std::string& line : lines) width = std::max(width, ImGui::CalcTextSize(line.c_str()).x);
  const float step = ImGui::GetTextLineHeight() + 2 * s, height = step * static_cast<float>(lines.size()) + 2 * pad;
  width = std::min(width + 2 * pad, std::max(60 * s, visible.width() - 28 * s));
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  Rect box{visible.x0 + 14 * s, visible.y0 + 14 * s, visible.x0 + 14 * s + width, visible.y0 + 14 * s + height};
  const Rect around{box.x0 - 30 * s, box.y0 - 30 * s, box.x1 + 30 * s, box.y1 + 30 * s};
  if (around.contains(mouse.x, mouse.y)) box.y1 = visible.y1 - 14 * s, box.y0 = box.y1 - height;
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  draw.AddRectFilled({box.x0, box.y0}, {box.x1, box.y1}, shade(palette::panel, 0.92f), 6 * s);
  draw.PushClipRect({box.x0, box.y0}, {box.x1 - pad / 2, box.y1}, true);
  ImVec2 at{box.x0 + pad, box.y0 + pad};
  for (const std::string& line : lines) {
    draw.AddText(at, shade(palette::text), line.c_str());
    at.y += step;
  }
  if (swatch) {
    const float edge = step - 3 * s, x = box.x1 - pad - edge, y = box.y0 + pad;
    draw.AddRectFilled({x, y}, {x + edge, y + edge}, shade({(*swatch)[0], (*swatch)[1], (*swatch)[2], 1}));
    draw.AddRect({x, y}, {x + edge, y + edge}, shade(palette::dim));
  }
  draw.PopClipRect();
  ImGui::PopFont();
  if (ui.log) ui.log->widget("inspector", box, joined(lines, " | "));
}

Legend legend_of(int view, double white) {
  const ViewEntry entry = view_entry(view);
  if (entry.stops) return legend_of_stops();
  if (entry.error == ErrorView::error) return grey_bar("relative error", 100, " %");
  if (entry.error == ErrorView::flip) return bar("FLIP", 1, "", heat);
  if (entry.view == View::noise) return grey_bar("estimated relative error", 100 * white, " %");
  if (entry.view == View::samples) return grey_bar("samples", white);
  if (entry.view == View::cost) return grey_bar("rays of a path", white);
  if (entry.view == View::depth) return grey_bar("depth, scene units", white);
  return {};
}

void draw_legend(Ui& ui, const Rect& visible, const Legend& legend) {
  if (legend.title.empty() || visible.width() < 260 * ui.scale) return;
  const float s = ui.scale, pad = 10 * s, width = (legend.steps ? 390 : 240) * s, bar_height = 12 * s;
  compat::push_font(ui.fonts.small);
  const float line = ImGui::GetTextLineHeight(), height = 2 * line + bar_height + 2 * pad + 8 * s;
  const Rect box{visible.x1 - 14 * s - std::min(width, visible.width() - 28 * s), visible.y1 - 14 * s - height,
                 visible.x1 - 14 * s, visible.y1 - 14 * s};
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  draw.AddRectFilled({box.x0, box.y0}, {box.x1, box.y1}, shade(palette::panel, 0.9f), 6 * s);
  draw.AddText({box.x0 + pad, box.y0 + pad}, shade(palette::text), legend.title.c_str());
  const float x0 = box.x0 + pad, x1 = box.x1 - pad, y = box.y0 + pad + line + 4 * s;
  const std::size_t count = legend.colours.size() - (legend.steps ? 0 : 1);
  const float step = (x1 - x0) / static_cast<float>(count);
  const auto tone = [&](std::size_t k) {
    const auto& c = legend.colours[k];
    return shade({c[0], c[1], c[2], 1});
  };
  for (std::size_t k = 0; k < count; ++k) {
    const float x = x0 + step * static_cast<float>(k);
    const ImU32 from = tone(k), to = tone(legend.steps ? k : k + 1);
    draw.AddRectFilledMultiColor({x, y}, {x + step, y + bar_height}, from, to, to, from);
  }
  draw.AddRect({x0, y}, {x1, y + bar_height}, shade(palette::dim, 0.6f));
  std::string numbers;
  for (std::size_t k = 0; k < legend.numbers.size(); ++k) {
    const std::string& text = legend.numbers[k];
    const float wide = ImGui::CalcTextSize(text.c_str()).x, all = static_cast<float>(legend.numbers.size());
    const float at = legend.steps ? x0 + step * (static_cast<float>(k) + 0.5f) - wide / 2
                                  : x0 + (x1 - x0 - wide) * static_cast<float>(k) / (all - 1);
    draw.AddText({at, y + bar_height + 3 * s}, shade(palette::dim), text.c_str());
    numbers += (k == 0 ? ": " : " ") + text;
  }
  ImGui::PopFont();
  if (ui.log) ui.log->widget("legend", box, legend.title + numbers);
}

}  // namespace tyndall
