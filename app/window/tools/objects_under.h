#pragma once
#include "app/window/tools/projection.h"
#include "app/window/tools/selection.h"

#include <vector>

/// All that lies one behind the other under a point of the picture.
namespace tyndall {

/// An object and how far along the line of sight it begins, scene units.
struct ObjectUnder {
  ObjectPath path;
  double distance = 0;
  bool medium = false;
};

/// The objects that a line of sight meets, nearest first; groups count as what is in them. Fog and boxes of media that
/// hold the eye are not met: they cannot be seen from there. Moving spheres are where they are at time 0.
std::vector<ObjectUnder> objects_under(const Scene& scene, ImagePoint at);

}  // namespace tyndall
