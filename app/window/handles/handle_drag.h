#pragma once
#include "app/window/handles/handles.h"

#include <optional>
#include <string>

/// What dragging a handle does to a scene. Pure: the scene at the beginning and two places of the mouse give the scene.
namespace tyndall {

/// A drag of a handle.
struct HandleDrag {
  Handle handle;
  ObjectPaths selected;         ///< at least one; the first is the one whose numbers snapping rounds
  Vec3d origin;                 ///< where the handles were, in the world
  WindowPoint from, to;         ///< of the mouse
  bool snap = false;            ///< to round numbers: about a fiftieth of the picture's height, or 5 degrees
  bool fine = false;            ///< a tenth of these
  std::optional<double> typed;  ///< in place of the mouse: scene units along the axis, the angle, or the size
};

/// What was done, for the line that tells the user of it.
struct DragResult {
  Vec3d moved;       ///< how far the objects went, world
  std::string said;  ///< "x +0.35"
};

/// Does it to `scene`, which is the scene at the beginning of the drag.
DragResult apply_drag(Scene& scene, const PictureFrame& frame, const HandleDrag& drag);

}  // namespace tyndall
