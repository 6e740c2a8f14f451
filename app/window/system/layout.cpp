#include "app/window/system/layout.h"

#include <algorithm>
#include <cmath>

namespace tyndall {

Layout make_layout(float width, float height, int image_width, int image_height, float scale, float column_units,
                   float strip) {
  const float bar = std::min(std::round(status_height * scale), height);
  const float column = std::min(std::round(column_units * scale), std::floor(width / 2));
  Layout layout;
  layout.status = {0, height - bar, width, height};
  layout.column = {width - column, 0, width, height - bar};
  const float strip_top = height - bar - std::round(std::min(strip, (height - bar) / 2));
  layout.area = {0, 0, width - column, strip_top};
  layout.strip = {0, strip_top, width - column, height - bar};
  const float w = layout.area.width(), h = layout.area.height();
  if (w <= 0 || h <= 0 || image_width <= 0 || image_height <= 0) return layout;
  const float fit = std::min(w / static_cast<float>(image_width), h / static_cast<float>(image_height));
  const float shown_w = std::max(1.0f, std::round(fit * static_cast<float>(image_width)));
  const float shown_h = std::max(1.0f, std::round(fit * static_cast<float>(image_height)));
  const float x0 = std::floor((w - shown_w) / 2), y0 = std::floor((h - shown_h) / 2);
  layout.image = {x0, y0, x0 + shown_w, y0 + shown_h};
  return layout;
}

}  // namespace tyndall
