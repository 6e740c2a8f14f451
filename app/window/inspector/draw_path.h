#pragma once
#include "app/report/noisy_path.h"
#include "app/window/panels/widgets.h"
#include "app/window/system/layout.h"

#include <array>
#include <string>
#include <vector>

namespace tyndall {

/// What is told of a path: a sentence, then a line for each stop; of a long path the first ones and the last.
std::vector<std::string> path_lines(const NoisyPath& found, const std::vector<PathStop>& stops);

/// Draws a path over the picture: lines between its stops, each with its number. visible: the part of the window in
/// which the picture is seen.
void draw_path(Ui& ui, const Scene& scene, const Rect& image, const Rect& visible, Vec3d eye,
               const std::vector<PathStop>& stops);

/// Draws lines of text in a corner of the picture, away from the mouse. swatch: a colour beside the first line; null:
/// none.
void draw_lines(Ui& ui, const Rect& visible, const std::vector<std::string>& lines, const std::array<float, 3>* swatch);

}  // namespace tyndall
