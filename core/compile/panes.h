#pragma once
#include "core/compile/crowds.h"
#include "core/compile/render_scene.h"

#include <vector>

/// Panes: boxes of glass through which light takes exact chains.
namespace tyndall {

/// A box of glass, in world space.
struct Pane {
  std::size_t shape;  ///< index into Flattened::shapes
  Vec3d middle;
  Vec3d edge[3];        ///< unit
  double half[3] = {};  ///< half lengths of the edges
  double index = 1.5;   ///< of refraction
  double fog = 0;       ///< density within
  int closed = 0;       ///< see PaneNumber
};

/// The least index with which light that enters a box by one face cannot leave by a face at right angles to it: the
/// square root of 2, and a little.
inline constexpr double least_pane_index = 1.4143;

/// All panes. Boxes of a lower index are left out, and boxes that a surface, or the boundary of a medium, reaches into.
/// flats: of the scene.
std::vector<Pane> list_panes(const Flattened& flat, const std::vector<Flat>& flats, const Scene& scene);

/// What a lamp sends to a pane, as a measure for choosing. 0: the lamp is so large that chance finds it well enough.
double worth_of(const Pane& pane, const Lights& lights, std::size_t light, Vec3d origin);

/// Appends its numbers; see PaneNumber.
void append_numbers(const Pane& pane, Vec3d origin, std::vector<float>& numbers);

}  // namespace tyndall
