#include "app/report/heat_map.h"

#include "core/image/tonemap.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>

namespace tyndall {
namespace {

// Heights of the parts of the scale, in pixels, from its top: a gap, the colours, the marks, the text.
constexpr int gap = 4, bar = 8, mark = 3, dot = 2;
static_assert(gap + bar + mark + 5 * dot + 1 == heat_scale_rows);

/// The few signs that the scale needs, each as 3 x 5 dots, row by row.
std::array<std::string_view, 5> dots_of(char sign) {
  if (sign == '0') return {"###", "# #", "# #", "# #", "###"};
  if (sign == '1') return {" # ", "## ", " # ", " # ", "###"};
  if (sign == '5') return {"###", "#  ", "###", "  #", "###"};
  return {"   ", "   ", "   ", "   ", " # "};
}

void set(LinearImage& image, int x, int y, const std::array<float, 3>& colour = {0.8f, 0.8f, 0.8f}) {
  if (x < 0 || x >= image.width || y < 0 || y >= image.height) return;
  std::copy(colour.begin(), colour.end(), image.rgb.begin() + 3 * (std::ptrdiff_t{y} * image.width + x));
}

void write(LinearImage& image, int left, int top, std::string_view text) {
  for (const char sign : text) {
    const auto rows = dots_of(sign);
    for (int y = 0; y < 5 * dot; ++y)
      for (int x = 0; x < 3 * dot; ++x)
        if (rows[static_cast<std::size_t>(y / dot)][static_cast<std::size_t>(x / dot)] == '#')
          set(image, left + x, top + y);
    left += 4 * dot;
  }
}

int width_of(std::string_view text) { return (4 * static_cast<int>(text.size()) - 1) * dot; }

void draw_scale(LinearImage& image, int top) {
  const int last = image.width - 1;
  for (int y = 0; y < bar; ++y)
    for (int x = 0; x <= last; ++x)
      set(image, x, top + gap + y, heat(static_cast<float>(x) / static_cast<float>(std::max(last, 1))));
  const auto label = [&](int x, int left, std::string_view text) {
    for (int y = 0; y < mark; ++y) set(image, x, top + gap + bar + y);
    write(image, left, top + gap + bar + mark + 1, text);
  };
  label(0, 0, "0");
  if (last > 80) label(last / 2, last / 2 - width_of("0.5") / 2, "0.5");
  if (last > 20) label(last, last + 1 - width_of("1"), "1");
}

}  // namespace

LinearImage heat_colours(const std::vector<float>& values, int width, int height) {
  LinearImage image{width, height, {}};
  for (const float value : values) {
    const auto colour = heat(value);
    image.rgb.insert(image.rgb.end(), colour.begin(), colour.end());
  }
  return image;
}

LinearImage heat_map(const std::vector<float>& values, int width, int height) {
  LinearImage image = heat_colours(values, width, height);
  image.height += heat_scale_rows;
  image.rgb.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(image.height));
  draw_scale(image, height);
  return image;
}

std::array<float, 3> heat(float value) {
  static constexpr std::array<std::array<float, 3>, 5> stops = {
      {{0, 0, 0}, {0.30f, 0.07f, 0.45f}, {0.78f, 0.20f, 0.34f}, {0.98f, 0.60f, 0.25f}, {1, 1, 0.85f}}};
  if (std::isnan(value)) return {0, 1, 0};
  const float at = std::clamp(value, 0.0f, 1.0f) * 4;
  const std::size_t i = std::min<std::size_t>(static_cast<std::size_t>(at), 3);
  const float part = at - static_cast<float>(i);
  std::array<float, 3> colour{};
  for (std::size_t k = 0; k < 3; ++k) colour[k] = srgb_decode(stops[i][k] + part * (stops[i + 1][k] - stops[i][k]));
  return colour;
}

}  // namespace tyndall
