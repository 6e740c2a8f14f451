#pragma once
#include "app/window/accuracy/views.h"
#include "app/window/panels/widgets.h"

#include <array>
#include <string>
#include <vector>

namespace tyndall {

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

}  // namespace tyndall
