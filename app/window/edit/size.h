#pragma once
#include "app/window/edit/drag_rounding.h"
#include "app/window/tools/selection.h"

#include <vector>

/// Making shapes larger and smaller, by the numbers that they have of their own.
namespace tyndall {

/// A number of a shape's size, and the place from which it can be pulled.
struct SizeGrip {
  Vec3d at;          ///< in the world
  Vec3d pull;        ///< unit: pulling this way makes the shape larger
  double value = 0;  ///< grows as far as the grip is pulled: a radius, an edge's length, how far out a face of a box is
  const char* name;  ///< "radius", "u", "v", "x", "-x", "y", "-y", "z", "-z"
};

/// The grips of a shape: a sphere's radius, a quad's edges, a box's faces. None for groups. across: unit, where a
/// sphere's grip is seen from its centre.
std::vector<SizeGrip> size_grips(const Scene& scene, const ObjectPath& path, Vec3d across);

/// Sets the number of a grip (its place in the list). What cannot be so small stops at `minimum` > 0.
void set_size(Scene& scene, const ObjectPath& path, std::size_t grip, double value, double minimum);

}  // namespace tyndall
