#pragma once
#include <algorithm>
#include <cmath>

/// How the window is divided into picture, panels and status line.
namespace tyndall {

/// A rectangle of the window, y down, in window units.
struct Rect {
  float x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  float width() const { return x1 - x0; }
  float height() const { return y1 - y0; }
  bool contains(float x, float y) const { return x >= x0 && x < x1 && y >= y0 && y < y1; }
  bool operator==(const Rect&) const = default;
};

/// Where things are. Empty rectangles (no width or height) are not drawn.
struct Layout {
  Rect area;    ///< left: where the image may be
  Rect strip;   ///< beneath it: small pictures, and the film's bar
  Rect image;   ///< the image itself, its aspect kept, in the middle of the area
  Rect column;  ///< right: the panels
  Rect status;  ///< bottom line
};

/// Width of the column at first and as the user may drag it, and height of the status line, in window units at scale 1.
inline constexpr float column_width = 372, narrowest_column = 300, widest_column = 640, status_height = 30;

/// column_units: its width in units of the design; 0: it is hidden. A window narrower than twice the column gives it
/// half. strip: height of the strip, in window units; it gets at most half of what the image would have.
inline Layout make_layout(float width, float height, int image_width, int image_height, float scale, float column_units,
                          float strip = 0) {
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
