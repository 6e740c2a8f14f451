#pragma once
#include "app/window/panels/widgets.h"

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
