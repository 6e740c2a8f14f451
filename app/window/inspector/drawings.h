#pragma once
#include "app/window/accuracy/views.h"
#include "app/window/panels/widgets.h"
#include "app/window/system/input_events.h"
#include "app/window/system/layout.h"
#include "app/window/tools/projection.h"
#include "core/film/film.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

/// What is drawn over the picture: what the colours of a view mean, and the rectangle that is refined first.
namespace tyndall {

/// Where a point of the image is in the window. Those far outside, which would overflow the draw list's arithmetic, are
/// moved nearer.
ImVec2 in_window(const Rect& image, ImagePoint p);

/// A bar of colours with numbers beneath.
struct Legend {
  std::string title;                          ///< "" : the view needs none
  std::vector<std::array<float, 3>> colours;  ///< as the screen shows them, from left to right
  bool steps = false;                         ///< each colour fills its part of the bar; else they are blended
  std::vector<std::string> numbers;           ///< spread over the bar's length; of steps one in the middle of each
};

/// What the colours of a view mean. view: see view_entry(); white: see Frame.
Legend legend_of(int view, double white);

/// Draws it at the foot of the picture, on the right.
void draw_legend(Ui& ui, const Rect& visible, const Legend& legend);

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
  bool waits_ = false;
  std::optional<ImagePoint> from_;
  ImagePoint to_;
};

}  // namespace tyndall
