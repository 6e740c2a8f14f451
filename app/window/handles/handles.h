#pragma once
#include "app/window/edit/arrange.h"
#include "app/window/edit/object_list.h"
#include "app/window/system/layout.h"
#include "app/window/system/ui_log.h"
#include "app/window/tools/projection.h"

#include <optional>
#include <string>
#include <vector>

/// This room lets the user move, turn and size the selected objects with the mouse, right in the picture.
namespace tyndall {

/// A place of the window, y down, window units.
struct WindowPoint {
  double x = 0, y = 0;
};

/// What a handle does.
enum class HandleKind { plane, along_x, along_y, along_z, rotate, size };

/// A handle on the selection.
struct Handle {
  HandleKind kind = HandleKind::plane;
  std::size_t grip = 0;  ///< of HandleKind::size: which, see size_grips()
  /// What is drawn and can be taken: a point, the two ends of an arrow, or a closed line.
  std::vector<WindowPoint> points;
  bool operator==(const Handle& other) const { return kind == other.kind && grip == other.grip; }
};

/// How the picture lies in the window.
struct PictureFrame {
  Projection projection;
  Rect image;
  double scale = 1;  ///< window units per unit of the design

  std::optional<WindowPoint> point(Vec3d p) const;
  ViewRay view_ray(WindowPoint at) const;
  /// Scene units per window unit at the depth of a point.
  double unit_at(Vec3d p) const;
  /// Where a unit vector at a point leads in the picture: its length is 1 across the line of sight and 0 along it.
  WindowPoint seen_direction(Vec3d p, Vec3d direction) const;
  /// Below this length of seen_direction() a way is seen so much from its end that the mouse could hardly follow it.
  static constexpr double min_followed = 0.3;
};
PictureFrame frame_of(const Scene& scene, const Rect& image, double scale);

/// "move", "x", "y", "z", "turn", "size.radius": of the log.
std::string name_of_handle(const Scene& scene, const ObjectPaths& selected, const Handle& handle);

/// The handles of a selection, whose first object is the one that can be sized. origin: where the handles that move
/// are, in the world.
std::vector<Handle> handles_of(const Scene& scene, const PictureFrame& frame, const ObjectPaths& selected,
                               Vec3d origin);

/// The handle at a place; nothing where there is none.
std::optional<Handle> handle_at(const std::vector<Handle>& handles, WindowPoint at, double scale);

/// Draws the handles over the picture, the hovered one bright. only: just that one, while it is dragged.
void draw_handles(const PictureFrame& frame, const std::vector<Handle>& handles, const std::optional<Handle>& hovered,
                  bool only);
/// What is being done, at the foot of the picture.
void draw_handle_text(const PictureFrame& frame, const std::string& text);
/// Tells the log where each handle can be taken. names: of the handles.
void log_handles(UiLog& log, const std::vector<Handle>& handles, const std::vector<std::string>& names, double scale);

}  // namespace tyndall
