#pragma once
#include "app/report/replay.h"
#include "app/window/accuracy/views.h"
#include "app/window/panels/widgets.h"
#include "app/window/system/layout.h"
#include "app/window/tools/projection.h"

#include <array>
#include <string>
#include <vector>

/// What is drawn over the picture to explain it: a path, lines of text, and what the colours of a view mean.
namespace tyndall {

/// Where a point of the image is in the window. Those far outside, which would overflow the draw list's arithmetic, are
/// moved nearer.
ImVec2 in_window(const Rect& image, ImagePoint p);

/// What is told of a path: a sentence, then a line for each stop; of a long path the first ones and the last.
std::vector<std::string> path_lines(const NoisyPath& found, const std::vector<PathStop>& stops);

/// Draws a path over the picture: lines between its stops, each with its number. visible: the part of the window in
/// which the picture is seen.
void draw_path(Ui& ui, const Scene& scene, const Rect& image, const Rect& visible, Vec3d eye,
               const std::vector<PathStop>& stops);

/// Draws lines of text in a corner of the picture, away from the mouse. swatch: a colour beside the first line; null:
/// none.
void draw_lines(Ui& ui, const Rect& visible, const std::vector<std::string>& lines, const std::array<float, 3>* swatch);

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
