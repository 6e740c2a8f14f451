#pragma once
#include "app/window/tools/projection.h"
#include "app/window/tools/selection.h"

#include <vector>

/// The lines that mark the selected object in the picture.
namespace tyndall {

/// The outline of an object as the camera sees it, hidden or not: a sphere's silhouette, the edges of quads, the
/// silhouette of boxes. Of a group: of what is in it, up to a limit. What is behind the eye is left out.
std::vector<ImageLine> outline(const Scene& scene, const ObjectPath& path);

}  // namespace tyndall
