#include "app/report/heat_map.h"
#include "app/window/inspector/inspector.h"
#include "app/window/picture/display.h"
#include "core/image/tonemap.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

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

/// The upper left and the lower right corner of a rectangle that was drawn from one point to another.
ImageLine corners(ImagePoint from, ImagePoint to) {
  return {{std::min(from.x, to.x), std::min(from.y, to.y)}, {std::max(from.x, to.x), std::max(from.y, to.y)}};
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
  const WithFont small(ui.fonts.small);
  const float line = ImGui::GetTextLineHeight(), height = 2 * line + bar_height + 2 * pad + 8 * s;
  const Rect box{visible.x1 - 14 * s - std::min(width, visible.width() - 28 * s), visible.y1 - 14 * s - height,
                 visible.x1 - 14 * s, visible.y1 - 14 * s};
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  draw.AddRectFilled({box.x0, box.y0}, {box.x1, box.y1}, shade(palette::panel, 0.9f), 6 * s);
  draw.AddText({box.x0 + pad, box.y0 + pad}, shade(palette::text), legend.title.c_str());
  const float x0 = box.x0 + pad, x1 = box.x1 - pad, y = box.y0 + pad + line + 4 * s;
  const std::size_t count = legend.colours.size() - (legend.steps ? 0 : 1);
  const float step = (x1 - x0) / static_cast<float>(count);
  const auto tone = [](const std::array<float, 3>& c) { return shade({c[0], c[1], c[2], 1}); };
  for (std::size_t k = 0; k < count; ++k) {
    const float x = x0 + step * static_cast<float>(k);
    const ImU32 from = tone(legend.colours[k]), to = tone(legend.colours[legend.steps ? k : k + 1]);
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
  const auto inside = [&](float x, float y) {
    return ImagePoint{std::clamp((x - image.x0) / image.width(), 0.0f, 1.0f),
                      std::clamp((y - image.y0) / image.height(), 0.0f, 1.0f)};
  };
  if (waits_ && free && mouse.clicked[0]) {
    from_ = inside(mouse.pressed_x[0], mouse.pressed_y[0]);
    waits_ = false;
  }
  if (!from_) return {};
  to_ = inside(mouse.x, mouse.y);
  if (mouse.down[0]) return {};
  const auto [low, high] = corners(*from_, to_);
  from_.reset();
  const ImVec2 a = in_window(image, low), b = in_window(image, high);
  if (b.x - a.x < 3 || b.y - a.y < 3) return Region{};
  constexpr double rounding = 0.01;  // of a pixel
  const auto first = [](double at, int size) { return static_cast<int>(std::floor(at * size + rounding)); };
  const auto last = [](double at, int size) { return static_cast<int>(std::ceil(at * size - rounding)); };
  return Region{first(low.x, width), first(low.y, height), last(high.x, width), last(high.y, height)};
}

void RectangleTool::draw(Ui& ui, const Rect& image, const Rect& visible, const Region& region, int width, int height,
                         const std::string& text) const {
  const ImageLine of_region{{1.0 * region.x0 / width, 1.0 * region.y0 / height},
                            {1.0 * region.x1 / width, 1.0 * region.y1 / height}};
  const auto [low, high] = from_ ? corners(*from_, to_) : of_region;
  if (high.x <= low.x || image.width() <= 0) return;
  const float s = ui.scale;
  const ImVec2 a = in_window(image, low), b = in_window(image, high);
  const Rect rect{a.x, a.y, b.x, b.y};
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  draw.PushClipRect({visible.x0, visible.y0}, {visible.x1, visible.y1}, true);
  draw.AddRect({rect.x0 - s, rect.y0 - s}, {rect.x1 + s, rect.y1 + s}, shade(palette::ink, 0.7f), 0, 0, 3 * s);
  draw.AddRect({rect.x0, rect.y0}, {rect.x1, rect.y1}, shade(palette::amber), 0, 0, 1.5f * s);
  if (!from_ && !text.empty()) {
    const WithFont small(ui.fonts.small);
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const float x = std::max(rect.x0, visible.x0), y = std::max(rect.y0 - size.y - 6 * s, visible.y0);
    draw.AddRectFilled({x, y}, {x + size.x + 10 * s, y + size.y + 4 * s}, shade(palette::panel, 0.9f), 3 * s);
    draw.AddText({x + 5 * s, y + 2 * s}, shade(palette::text), text.c_str());
  }
  draw.PopClipRect();
  if (ui.log) ui.log->widget("rectangle", rect, text);
}

}  // namespace tyndall
