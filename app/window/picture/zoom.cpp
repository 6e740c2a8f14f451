#include "app/window/picture/zoom.h"

#include <algorithm>
#include <cmath>

namespace tyndall {

Rect overlap(const Rect& a, const Rect& b) {
  const float x0 = std::max(a.x0, b.x0), y0 = std::max(a.y0, b.y0);
  return {x0, y0, std::max(x0, std::min(a.x1, b.x1)), std::max(y0, std::min(a.y1, b.y1))};
}

Rect ImageZoom::place(const Rect& area, const Rect& fit, int width, int height, float dots) {
  area_ = area, image_ = fit;
  fit_ = shown_ = fit.width() * dots / static_cast<float>(std::max(1, width));
  if (fits() || fit.width() <= 0) return image_;
  shown_ = scale_;
  const float w = static_cast<float>(width) * scale_ / dots, h = static_cast<float>(height) * scale_ / dots;
  // On whole pixels of the screen, so that at actual size each of the picture's is one of them.
  const auto rounded = [dots](float v) { return std::round(v * dots) / dots; };
  const float x0 = rounded((area.x0 + area.x1) / 2 - at_x_ * w), y0 = rounded((area.y0 + area.y1) / 2 - at_y_ * h);
  return image_ = {x0, y0, x0 + w, y0 + h};
}

/// What is at (x, y) now is there at the new scale, too. A picture that is smaller than the area goes to its middle.
void ImageZoom::set(float scale, float x, float y) {
  if (image_.width() <= 0 || image_.height() <= 0) return;
  const float u = (x - image_.x0) / image_.width(), v = (y - image_.y0) / image_.height();
  const float grown = scale / shown_, w = image_.width() * grown, h = image_.height() * grown;
  scale_ = scale;
  at_x_ = u + ((area_.x0 + area_.x1) / 2 - x) / w;
  at_y_ = v + ((area_.y0 + area_.y1) / 2 - y) / h;
  if (scale < fit_) at_x_ = at_y_ = 0.5f;
  limit();
}

/// The middle of the area always shows some of the picture, so that it cannot be lost.
void ImageZoom::limit() {
  at_x_ = std::clamp(at_x_, 0.0f, 1.0f);
  at_y_ = std::clamp(at_y_, 0.0f, 1.0f);
}

void ImageZoom::enlarge(float factor, float x, float y) {
  const float wanted = shown_ * factor, minimum = std::min(1.0f, fit_);
  if (wanted <= minimum * 1.001f && fit_ <= 1) return fit();
  set(std::clamp(wanted, minimum, std::max(maximum, fit_)), x, y);
}

void ImageZoom::move(float dx, float dy) {
  if (fits() || image_.width() <= 0) return;
  at_x_ -= dx / image_.width();
  at_y_ -= dy / image_.height();
  limit();
}

void ImageZoom::toggle(float x, float y) {
  if (!fits() && scale_ == 1) return fit();
  set(1, x, y);
}

}  // namespace tyndall
