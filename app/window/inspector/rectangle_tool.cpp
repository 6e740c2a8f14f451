#include "app/window/inspector/rectangle_tool.h"

#include "app/window/system/imgui_compat.h"

#include <algorithm>
#include <cmath>

namespace tyndall {

bool RectangleTool::cancel() {
  const bool was = active();
  waits_ = false;
  from_.reset();
  return was;
}

std::optional<Region> RectangleTool::update(const Mouse& mouse, const Rect& image, bool free, int width, int height) {
  if (image.width() <= 0 || image.height() <= 0) return {};
  const auto relative = [&](float x, float y) {
    return RelativePoint{std::clamp((x - image.x0) / image.width(), 0.0f, 1.0f),
                         std::clamp((y - image.y0) / image.height(), 0.0f, 1.0f)};
  };
  if (waits_ && free && mouse.clicked[0]) {
    from_ = relative(mouse.pressed_x[0], mouse.pressed_y[0]);
    waits_ = false;
  }
  if (!from_) return {};
  to_ = relative(mouse.x, mouse.y);
  if (mouse.down[0]) return {};
  constexpr float rounding = 0.01f;  // of a pixel
  const auto low = [](float a, float b, int size) {
    return static_cast<int>(std::floor(std::min(a, b) * static_cast<float>(size) + rounding));
  };
  const auto high = [](float a, float b, int size) {
    return static_cast<int>(std::ceil(std::max(a, b) * static_cast<float>(size) - rounding));
  };
  const RelativePoint from = *std::exchange(from_, std::nullopt);
  if (std::abs(from.x - to_.x) * image.width() < 3 || std::abs(from.y - to_.y) * image.height() < 3) return Region{};
  return Region{low(from.x, to_.x, width), low(from.y, to_.y, height), high(from.x, to_.x, width),
                high(from.y, to_.y, height)};
}

void RectangleTool::draw(Ui& ui, const Rect& image, const Rect& visible, const Region& region, int width, int height,
                         const std::string& text) const {
  RelativePoint low{static_cast<float>(region.x0) / static_cast<float>(width),
                    static_cast<float>(region.y0) / static_cast<float>(height)};
  RelativePoint high{static_cast<float>(region.x1) / static_cast<float>(width),
                     static_cast<float>(region.y1) / static_cast<float>(height)};
  if (from_) {
    low = {std::min(from_->x, to_.x), std::min(from_->y, to_.y)};
    high = {std::max(from_->x, to_.x), std::max(from_->y, to_.y)};
  }
  if (high.x <= low.x || image.width() <= 0) return;
  const float s = ui.scale;
  const Rect rect{image.x0 + low.x * image.width(), image.y0 + low.y * image.height(),
                  image.x0 + high.x * image.width(), image.y0 + high.y * image.height()};
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  draw.PushClipRect({visible.x0, visible.y0}, {visible.x1, visible.y1}, true);
  draw.AddRect({rect.x0 - s, rect.y0 - s}, {rect.x1 + s, rect.y1 + s}, shade(palette::ink, 0.7f), 0, 0, 3 * s);
  draw.AddRect({rect.x0, rect.y0}, {rect.x1, rect.y1}, shade(palette::amber), 0, 0, 1.5f * s);
  if (!from_ && !text.empty()) {
    compat::push_font(ui.fonts.small);
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const float x = std::max(rect.x0, visible.x0), y = std::max(rect.y0 - size.y - 6 * s, visible.y0);
    draw.AddRectFilled({x, y}, {x + size.x + 10 * s, y + size.y + 4 * s}, shade(palette::panel, 0.9f), 3 * s);
    draw.AddText({x + 5 * s, y + 2 * s}, shade(palette::text), text.c_str());
    ImGui::PopFont();
  }
  draw.PopClipRect();
  if (ui.log) ui.log->widget("rectangle", rect, text);
}

}  // namespace tyndall
