#include "app/window/inspector/draw_path.h"

#include "app/window/system/imgui_compat.h"
#include "app/window/tools/camera_control.h"
#include "app/window/tools/projection.h"
#include "core/base/text.h"

#include <fmt/core.h>

#include <algorithm>

namespace tyndall {
namespace {

constexpr std::size_t max_told = 18;  // stops of a path

ImVec2 in_window(const Rect& image, ImagePoint p) {
  const auto limited = [](double v) { return static_cast<float>(std::clamp(v, -20.0, 21.0)); };
  return {image.x0 + limited(p.x) * image.width(), image.y0 + limited(p.y) * image.height()};
}

void draw_number(Ui& ui, ImDrawList& draw, ImVec2 at, std::size_t number, bool light) {
  const float s = ui.scale;
  draw.AddCircleFilled(at, 4 * s, shade(light ? palette::amber : palette::blue), 16);
  draw.AddCircle(at, 4.5f * s, shade(palette::ink, 0.8f), 16, s);
  const std::string text = std::to_string(number);
  const ImVec2 from{at.x + 7 * s, at.y - 7 * s};
  draw.AddText({from.x + s, from.y + s}, shade(palette::ink, 0.9f), text.c_str());
  draw.AddText(from, shade(palette::text), text.c_str());
}

}  // namespace

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
    const Vec3d from = points.empty() ? eye : points.back();
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

}  // namespace tyndall
