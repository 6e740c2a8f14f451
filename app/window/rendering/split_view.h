#pragma once
#include "app/window/panels/widgets.h"
#include "app/window/system/mouse.h"

#include <string>

/// Two pictures side by side in one, A on the left of a divider, B on its right.
namespace tyndall {

/// Where the divider is.
struct Divider {
  float part = 0.5f;  ///< of the image's width
  bool hovered = false, dragged = false;

  float x(const Rect& image) const { return image.x0 + part * image.width(); }
  /// Whether a press at that place takes the divider. reach: to either side.
  bool is_at(const Rect& image, float mouse_x, float mouse_y, float reach) const;
  /// Goes along with the mouse while it is dragged; to be called in each drawing. free: nothing else has the mouse.
  /// Returns whether the divider has the mouse.
  bool follow(const Mouse& mouse, const Rect& image, bool free, float reach);
  /// Goes to the mouse; a little of each half stays.
  void drag_to(const Rect& image, float mouse_x);
};

/// What is said of the halves.
struct SplitLabels {
  std::string a, b;
};

/// Divider, and in each half's upper corner what it is.
void draw_split(Ui& ui, const Rect& image, const Divider& divider, const SplitLabels& labels);

}  // namespace tyndall
