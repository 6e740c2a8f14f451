#include "app/window/inspector/legend.h"

#include "app/report/heat_map.h"
#include "app/window/picture/stops.h"
#include "app/window/system/imgui_compat.h"
#include "core/image/tonemap.h"

#include <fmt/core.h>

#include <algorithm>

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
  Legend legend{"stops from middle grey", {}, true, {}};
  for (const ScreenColour& c : stop_colours) legend.colours.push_back({c.r, c.g, c.b});
  for (int stop = darkest_stop; stop <= brightest_stop; ++stop) legend.numbers.push_back(fmt::format("{:+}", stop));
  legend.numbers[static_cast<std::size_t>(-darkest_stop)] = "0";
  return legend;
}

}  // namespace

Legend legend_of(int view, double white) {
  const ViewEntry entry = view_entry(view);
  if (entry.stops) return legend_of_stops();
  if (entry.error == ErrorView::error) return grey_bar("relative error", 100, " %");
  if (entry.error == ErrorView::flip) return bar("FLIP", 1, "", heat);
  switch (entry.view) {
    case View::noise:
      return grey_bar("estimated relative error", 100 * white, " %");
    case View::samples:
      return grey_bar("samples", white);
    case View::cost:
      return grey_bar("rays of a path", white);
    case View::depth:
      return grey_bar("depth, scene units", white);
    default:
      return {};
  }
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
