#include "app/window/inspector/drawings.h"

#include "app/report/heat_map.h"
#include "app/window/picture/display.h"
#include "app/window/system/imgui_compat.h"
#include "core/image/tonemap.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tyndall {
namespace {

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
  Legend legend{"stops from middle grey", {stop_colours.begin(), stop_colours.end()}, true, {}};
  for (int stop = darkest_stop; stop <= brightest_stop; ++stop) legend.numbers.push_back(fmt::format("{:+}", stop));
  legend.numbers[static_cast<std::size_t>(-darkest_stop)] = "0";
  return legend;
}

}  // namespace

ImVec2 in_window(const Rect& image, ImagePoint p) {
  const auto limited = [](double v) { return static_cast<float>(std::clamp(v, -20.0, 21.0)); };
  return {image.x0 + limited(p.x) * image.width(), image.y0 + limited(p.y) * image.height()};
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
