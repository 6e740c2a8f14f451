#pragma once
#include "app/window/panels/widgets.h"
#include "app/window/system/input_events.h"
#include "app/window/system/layout.h"
#include "core/film/film.h"

#include <optional>
#include <string>

namespace tyndall {

/// Lets the user draw a rectangle over the picture.
class RectangleTool {
 public:
  /// Waits for a drag.
  void begin() { waits_ = true; }
  /// Nothing is drawn any more. Returns whether something was waited for or drawn.
  bool cancel();
  bool active() const { return waits_ || from_; }

  /// To be called in each drawing. free: nothing else has the mouse; width, height: of the picture, in pixels. Returns
  /// the rectangle when it was drawn; a click alone gives an empty one.
  std::optional<Region> update(const Mouse& mouse, const Rect& image, bool free, int width, int height);
  /// Draws the rectangle that is being drawn; else the one of that region, with a text above it.
  void draw(Ui& ui, const Rect& image, const Rect& visible, const Region& region, int width, int height,
            const std::string& text) const;

 private:
  /// A point of the picture, as fractions of it.
  struct RelativePoint {
    float x = 0, y = 0;
  };
  bool waits_ = false;
  std::optional<RelativePoint> from_;
  RelativePoint to_;
};

}  // namespace tyndall
