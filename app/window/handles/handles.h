#pragma once
#include "app/window/document/document.h"
#include "app/window/edit/arrange.h"
#include "app/window/edit/object_list.h"
#include "app/window/system/input_events.h"
#include "app/window/system/layout.h"
#include "app/window/system/ui_log.h"
#include "app/window/tools/projection.h"

#include <optional>
#include <string>
#include <vector>

/// This room lets the user move, turn and size the selected objects with the mouse, right in the picture; and by the
/// keyboard: G, then X, Y or Z, then the mouse or a number. What that does to a scene is pure: the scene at the
/// beginning and two places of the mouse give the scene.
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
/// Tells the log where each handle of a selection can be taken: "handle.move", "handle.x", "handle.turn",
/// "handle.size.radius".
void log_handles(UiLog& log, const Scene& scene, const ObjectPath& first, const std::vector<Handle>& handles,
                 double scale);

/// A drag of a handle.
struct HandleDrag {
  Handle handle;
  ObjectPaths selected;           ///< at least one; the first is the one whose numbers snapping rounds
  Vec3d origin;                   ///< where the handles were, in the world
  WindowPoint from, to;           ///< of the mouse
  bool snap = false;              ///< to round numbers: about a fiftieth of the picture's height, or 5 degrees
  bool fine = false;              ///< a tenth of these
  std::optional<double> typed{};  ///< in place of the mouse: scene units along the axis, the angle, or the size

  bool moved() const { return typed || to.x != from.x || to.y != from.y; }
};

/// Does it to `scene`, which is the scene at the beginning of the drag. Returns what the user is told of it: "x +0.35".
std::string apply_drag(Scene& scene, const PictureFrame& frame, const HandleDrag& drag);

/// Moves, turns and sizes the selected objects.
class HandleTool {
 public:
  /// To be called in each drawing, before the tool that orbits; changes the objects of the scene. free: nothing else
  /// has the mouse. Returns whether the handles have it.
  bool update(const Mouse& mouse, const Layout& layout, float scale, bool free, const ObjectPaths& selected,
              EditedScene& scene);

  /// Begins to move the selection with the mouse, without a button: until a click or Enter, or Esc or a right click,
  /// which takes it back. Nothing happens without a selection.
  void grab(const Mouse& mouse, const ObjectPaths& selected, const Scene& scene);
  /// A key while something is moved; key: GLFW's number. Returns whether it was meant for this.
  bool take_key(int key);
  /// A character of a number or a sum that is typed meanwhile ("1/4", "2*pi"). Returns whether it was meant for this.
  bool take_character(char character);
  /// Gives up what is being done, and takes it back with the next drawing.
  void cancel() {
    if (running_) running_->cancelled = true;
  }

  /// Whether something is being moved, turned or sized.
  bool active() const { return running_.has_value(); }
  /// The handle under the mouse, or the one that is dragged.
  const std::optional<Handle>& hovered() const { return hovered_; }
  /// Whether a handle was pressed and let go without moving it, in this drawing: a click on what lies behind it.
  bool clicked_through() const { return clicked_through_; }
  /// What is being done: "x +0.35"; "": nothing.
  std::string said() const { return running_ ? running_->said : ""; }

  /// Where the handles are: in the middle of the first object, or where it was clicked if its middle is not in the
  /// picture.
  Vec3d origin(const Scene& scene, const PictureFrame& frame, const ObjectPaths& selected) const;
  /// Remembers where the user clicked on an object.
  void clicked(const Scene& scene, const ObjectPath& object, Vec3d point);

 private:
  void follow_mouse(const Mouse& mouse, const PictureFrame& frame, EditedScene& scene);
  void read_typed();

  /// What is being moved, turned or sized, until it ends.
  struct Running {
    HandleDrag drag;
    std::vector<Object> start;  ///< the objects when it began
    std::vector<Material> materials;
    std::string said{}, typing{};
    bool grabbed = false, moved = false, confirmed = false, cancelled = false;
  };
  std::optional<Running> running_;
  std::optional<Handle> hovered_;
  bool waits_for_release_ = false, clicked_through_ = false;
  ObjectPath clicked_;
  Vec3d click_;  ///< from the middle of that object
};

}  // namespace tyndall
