#pragma once
#include "app/window/tools/selection.h"

#include <vector>

/// The lines that mark the selected object in the picture.
namespace tyndall {

/// A point of the image: x to the right and y down, both in [0, 1] inside it.
struct ImagePoint {
  double x = 0, y = 0;
};
/// Two points of a line.
struct ImageLine {
  ImagePoint a, b;
};

/// The outline of an object as the camera sees it, hidden or not: a sphere's silhouette, the edges of quads, the
/// silhouette of boxes. Of a group: of what is in it, up to a limit. What is behind the eye is left out.
std::vector<ImageLine> outline(const Scene& scene, const ObjectPath& path);

}  // namespace tyndall
