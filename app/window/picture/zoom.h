#pragma once
#include "app/window/system/layout.h"

/// How large the picture is shown, and which part of it.
namespace tyndall {

/// The picture as large as its area allows, or enlarged and moved by the user.
class ImageZoom {
 public:
  /// Where the picture is, in window units; it may reach beyond the area. fit: where it is when all of it is shown;
  /// width, height: of the picture, in pixels; dots: pixels of the screen in a window unit.
  Rect place(const Rect& area, const Rect& fit, int width, int height, float dots);
  bool fits() const { return scale_ <= 0; }
  /// Pixels of the screen in one of the picture, as place() has shown it last.
  float dots_a_pixel() const { return shown_; }

  // Of the picture as place() has shown it last.

  /// Enlarges the picture by a factor, or makes it smaller, down to where all of it is shown, or to actual size where
  /// that is less; what is at (x, y) stays.
  void enlarge(float factor, float x, float y);
  void move(float dx, float dy);
  /// One pixel of the picture for each of the screen, what is at (x, y) stays; all of the picture if it is so.
  void toggle(float x, float y);
  void fit() { scale_ = 0; }

  static constexpr float maximum = 64;  ///< dots a pixel

 private:
  float scale_ = 0;                  ///< dots a pixel; 0: as the area allows
  float at_x_ = 0.5f, at_y_ = 0.5f;  ///< the point of the picture, as fractions of it, in the middle of the area
  float shown_ = 1, fit_ = 1;        ///< dots a pixel, now and when all is shown
  Rect image_, area_;                ///< as place() has found them
  void set(float scale, float x, float y);
  void limit();
};

/// The part of two rectangles that both cover; empty, with no width or height, where they do not meet.
Rect overlap(const Rect& a, const Rect& b);

}  // namespace tyndall
