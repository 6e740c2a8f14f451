#include "app/window/handles/draw_handles.h"

#include "app/window/system/style.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

constexpr Tone red{0.94f, 0.33f, 0.31f, 1}, green{0.47f, 0.78f, 0.31f, 1}, blue{0.33f, 0.56f, 0.98f, 1};

Tone colour_of(HandleKind kind) {
  switch (kind) {
    case HandleKind::along_x:
      return red;
    case HandleKind::along_y:
    case HandleKind::rotate:
      return green;
    case HandleKind::along_z:
      return blue;
    default:
      return palette::text;
  }
}

ImVec2 at(WindowPoint p) {
  const auto limited = [](double v) { return static_cast<float>(std::clamp(v, -2e4, 2e4)); };
  return {limited(p.x), limited(p.y)};
}

void draw_arrow(ImDrawList& draw, const Handle& handle, ImU32 colour, float scale) {
  const ImVec2 from = at(handle.points[0]), to = at(handle.points[1]);
  const float dx = to.x - from.x, dy = to.y - from.y, length = std::max(1.0f, std::hypot(dx, dy));
  const ImVec2 direction{dx / length, dy / length}, head{11 * scale * direction.x, 11 * scale * direction.y};
  const ImVec2 side{-4.5f * scale * direction.y, 4.5f * scale * direction.x};
  draw.AddLine(from, {to.x - head.x, to.y - head.y}, colour, 2.5f * scale);
  draw.AddTriangleFilled(to, {to.x - head.x + side.x, to.y - head.y + side.y},
                         {to.x - head.x - side.x, to.y - head.y - side.y}, colour);
}

void draw_handle(ImDrawList& draw, const Handle& handle, Tone tone, float scale) {
  const ImU32 colour = shade(tone), dark = shade(palette::ink, 0.8f);
  const ImVec2 first = at(handle.points[0]);
  if (handle.points.size() == 2) return draw_arrow(draw, handle, colour, scale);
  if (handle.kind == HandleKind::rotate) {
    std::vector<ImVec2> ring;
    for (const WindowPoint& p : handle.points) ring.push_back(at(p));
    return draw.AddPolyline(ring.data(), static_cast<int>(ring.size()), colour, ImDrawFlags_Closed, 2 * scale);
  }
  if (handle.kind == HandleKind::plane) {
    draw.AddCircleFilled(first, 7 * scale, dark, 24);
    return draw.AddCircle(first, 6 * scale, colour, 24, 2 * scale);
  }
  const float half = 5 * scale;
  draw.AddRectFilled({first.x - half, first.y - half}, {first.x + half, first.y + half}, colour, 2 * scale);
  draw.AddRect({first.x - half, first.y - half}, {first.x + half, first.y + half}, dark, 2 * scale);
}

}  // namespace

void draw_handles(const PictureFrame& frame, const std::vector<Handle>& handles, const std::optional<Handle>& hovered,
                  bool only) {
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  const Rect& image = frame.image;
  draw.PushClipRect({image.x0, image.y0}, {image.x1, image.y1}, true);
  for (const Handle& handle : handles) {
    const bool on = hovered && *hovered == handle;
    if (!only || on)
      draw_handle(draw, handle, on ? palette::amber : colour_of(handle.kind), static_cast<float>(frame.scale));
  }
  draw.PopClipRect();
}

void draw_handle_text(const PictureFrame& frame, const std::string& text) {
  if (text.empty()) return;
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  const auto scale = static_cast<float>(frame.scale);
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const ImVec2 from{(frame.image.x0 + frame.image.x1 - size.x) / 2, frame.image.y0 + 14 * scale};
  draw.AddRectFilled({from.x - 10 * scale, from.y - 5 * scale},
                     {from.x + size.x + 10 * scale, from.y + size.y + 5 * scale}, shade(palette::panel, 0.9f),
                     5 * scale);
  draw.AddText(from, shade(palette::text), text.c_str());
}

void log_handles(UiLog& log, const std::vector<Handle>& handles, const std::vector<std::string>& names, double scale) {
  for (std::size_t k = 0; k < handles.size(); ++k) {
    // Of an arrow its head, of the ring its point that is nearest to the viewer.
    const auto lowest = std::max_element(handles[k].points.begin(), handles[k].points.end(),
                                         [](const WindowPoint& a, const WindowPoint& b) { return a.y < b.y; });
    const WindowPoint p = handles[k].kind == HandleKind::rotate ? *lowest : handles[k].points.back();
    const auto x = static_cast<float>(p.x), y = static_cast<float>(p.y), half = static_cast<float>(5 * scale);
    log.widget("handle." + names[k], {x - half, y - half, x + half, y + half}, "handle");
  }
}

}  // namespace tyndall
