#include "app/window/rendering/split_view.h"

#include "app/window/system/imgui_compat.h"

#include <algorithm>
#include <cmath>

namespace tyndall {

bool Divider::is_at(const Rect& image, float mouse_x, float mouse_y, float reach) const {
  return image.width() > 0 && mouse_y >= image.y0 && mouse_y < image.y1 && std::abs(mouse_x - x(image)) <= reach;
}

bool Divider::follow(const Mouse& mouse, const Rect& image, bool free, float reach) {
  const bool at = free && is_at(image, mouse.x, mouse.y, reach);
  // If drawing is slow, the mouse may have left the divider by the time its press is seen.
  if ((at || hovered) && free && mouse.clicked[0]) dragged = true;
  hovered = at;
  if (dragged && mouse.down[0]) drag_to(image, mouse.x);
  const bool has_it = dragged;
  dragged = dragged && mouse.down[0];
  return has_it;
}

void Divider::drag_to(const Rect& image, float mouse_x) {
  if (image.width() > 0) part = std::clamp((mouse_x - image.x0) / image.width(), 0.02f, 0.98f);
}

namespace {

/// What a half is, on a dark ground in the half's upper outer corner; in several lines where the half is narrow.
void draw_label(Ui& ui, const Rect& half, const std::string& text, bool right) {
  const float s = ui.scale, pad = 8 * s, mark = ImGui::CalcTextSize("A").x + pad;
  const float room = std::max(half.width() - mark - 4 * pad, 40 * s);
  const ImVec2 words = ImGui::CalcTextSize(text.c_str(), nullptr, false, room);
  const float width = mark + words.x + 2 * pad, height = words.y + 2 * pad;
  const float x = right ? half.x1 - width - pad : half.x0 + pad, y = half.y0 + pad;
  ImDrawList* draw = ImGui::GetBackgroundDrawList();
  draw->PushClipRect({half.x0, half.y0}, {half.x1, half.y1}, true);
  draw->AddRectFilled({x, y}, {x + width, y + height}, shade(palette::ink, 0.85f), 5 * s);
  draw->AddText({x + pad, y + pad}, shade(right ? palette::blue : palette::amber), right ? "B" : "A");
  draw->AddText(ImGui::GetFont(), ImGui::GetFontSize(), {x + pad + mark, y + pad}, shade(palette::text), text.c_str(),
                nullptr, room);
  draw->PopClipRect();
  if (ui.log) ui.log->widget(right ? "split.b" : "split.a", half, text);
}

}  // namespace

void draw_split(Ui& ui, const Rect& image, const Divider& divider, const SplitLabels& labels) {
  if (image.width() <= 0 || image.height() <= 0) return;
  const float x = std::round(divider.x(image)), middle = (image.y0 + image.y1) / 2, s = ui.scale;
  compat::push_font(ui.fonts.small);
  draw_label(ui, {image.x0, image.y0, x - 2 * s, image.y1}, labels.a, false);
  draw_label(ui, {x + 2 * s, image.y0, image.x1, image.y1}, labels.b, true);
  ImGui::PopFont();
  ImDrawList* draw = ImGui::GetBackgroundDrawList();
  draw->AddRectFilled({x - 2 * s, image.y0}, {x + 2 * s, image.y1}, shade(palette::ink, 0.55f));
  draw->AddLine({x, image.y0}, {x, image.y1}, shade(palette::text, 0.9f), s);
  draw->AddRectFilled({x - 5 * s, middle - 18 * s}, {x + 5 * s, middle + 18 * s}, shade(palette::text), 5 * s);
  for (const float way : {-1.5f, 1.5f})
    draw->AddLine({x + way * s, middle - 7 * s}, {x + way * s, middle + 7 * s}, shade(palette::ink, 0.6f), s);
  if (ui.log) ui.log->widget("divider", {x - 4 * s, image.y0, x + 4 * s, image.y1}, "");
}

}  // namespace tyndall
