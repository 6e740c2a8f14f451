#include "app/report/heat_map.h"

#include "core/image/tonemap.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>

namespace tyndall {
namespace {

// Heights of the parts of the scale, in pixels, from its top: a gap, the colours, the marks, the text.
constexpr int gap = 4, bar = 8, mark = 3, dot_size = 2;
static_assert(gap + bar + mark + 5 * dot_size + 1 == heat_scale_rows);

/// The texts of the scale.
using Dots = std::array<std::string_view, 5>;
constexpr Dots zero{"###", "# #", "# #", "# #", "###"}, one{" # ", "## ", " # ", " # ", "###"},
    half{"###     ###", "# #     #  ", "# #     ###", "# #       #", "###  #  ###"};

void set(LinearImage& image, int x, int y, const std::array<float, 3>& colour = {0.8f, 0.8f, 0.8f}) {
  if (x < 0 || x >= image.width || y < 0 || y >= image.height) return;
  std::copy(colour.begin(), colour.end(), image.rgb.begin() + 3 * (std::ptrdiff_t{y} * image.width + x));
}

void draw_scale(LinearImage& image, int top) {
  const int last = image.width - 1, text = top + gap + bar + mark + 1;
  for (int y = 0; y < bar; ++y)
    for (int x = 0; x <= last; ++x)
      set(image, x, top + gap + y, heat(static_cast<float>(x) / static_cast<float>(std::max(last, 1))));
  // Marks a place; the text begins so many of its halves to the left of `from`.
  const auto label = [&](int at, const Dots& rows, int from, int halves) {
    const int width = dot_size * static_cast<int>(rows[0].size());
    for (int y = 0; y < mark; ++y) set(image, at, top + gap + bar + y);
    for (int y = 0; y < 5 * dot_size; ++y)
      for (int x = 0; x < width; ++x)
        if (rows[static_cast<std::size_t>(y / dot_size)][static_cast<std::size_t>(x / dot_size)] == '#')
          set(image, from - halves * width / 2 + x, text + y);
  };
  label(0, zero, 0, 0);
  if (last > 80) label(last / 2, half, last / 2, 1);
  if (last > 20) label(last, one, last + 1, 2);
}

}  // namespace

LinearImage heat_map(const std::vector<float>& values, int width, int height, bool with_scale) {
  LinearImage image{width, height, {}};
  for (const float value : values) {
    const auto colour = heat(value);
    image.rgb.insert(image.rgb.end(), colour.begin(), colour.end());
  }
  if (!with_scale) return image;
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
