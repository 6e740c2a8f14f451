#include "app/window/handles/handles.h"

#include "app/text/numbers.h"
#include "app/window/tools/camera_control.h"
#include "core/base/math.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

constexpr double snaps_in_picture = 50;   // steps of snapping that fit into the picture's height, at least
constexpr double degrees_per_unit = 0.5;  // of the mouse, where the ring is seen from its edge

/// The grain that numbers get: of a point of the window, or of snapping.
DragRounding drag_rounding_of(const PictureFrame& frame, const HandleDrag& drag) {
  const double unit = frame.unit_at(drag.origin), height = frame.image.height();
  DragRounding drag_rounding = drag.snap ? nice_below(unit * height / snaps_in_picture) : decimal_below(unit);
  if (drag.fine) --drag_rounding.exponent;
  return drag_rounding;
}

/// Where the line of sight through a place of the window meets the plane through the origin that faces the camera.
Vec3d in_plane(const PictureFrame& frame, Vec3d origin, WindowPoint at) {
  const ViewRay view_ray = frame.view_ray(at);
  const Vec3d forward = axes_of(frame.projection.camera).forward;
  const double minimum = 1e-3 * target_distance(frame.projection.camera);
  const double depth = std::max(dot(origin - view_ray.origin, forward), minimum);
  return view_ray.origin + (depth / dot(view_ray.direction, forward)) * view_ray.direction;
}

/// How far along a line through the origin the point is that is nearest to the line of sight.
double along_line(const PictureFrame& frame, Vec3d origin, Vec3d direction, WindowPoint at) {
  const ViewRay view_ray = frame.view_ray(at);
  const Vec3d between = origin - view_ray.origin;
  const double cosine = dot(direction, view_ray.direction), sine2 = 1 - cosine * cosine;
  if (sine2 < 1e-6) return 0;
  return (cosine * dot(view_ray.direction, between) - dot(direction, between)) / sine2;
}

/// How far the mouse has pulled along a way. On one that is seen from its end the mouse cannot stay at what it has
/// taken, because a few pixels would lead to the horizon: there it pulls by a multiple of its own way instead.
double pulled(const PictureFrame& frame, const HandleDrag& drag, Vec3d direction) {
  const WindowPoint seen = frame.seen_direction(drag.origin, direction);
  if (const double fraction = std::hypot(seen.x, seen.y); fraction < PictureFrame::min_followed) {
    const double projected = (drag.to.x - drag.from.x) * seen.x + (drag.to.y - drag.from.y) * seen.y;
    return frame.unit_at(drag.origin) / PictureFrame::min_followed * projected / std::max(fraction, 1e-6);
  }
  return along_line(frame, drag.origin, direction, drag.to) - along_line(frame, drag.origin, direction, drag.from);
}

/// Degrees that the mouse has turned around the vertical through the origin.
double rotated(const PictureFrame& frame, const HandleDrag& drag) {
  const auto angle = [&](WindowPoint at) -> std::optional<double> {
    const ViewRay view_ray = frame.view_ray(at);
    if (std::abs(view_ray.direction.y) < 0.15) return {};
    const double t = (drag.origin.y - view_ray.origin.y) / view_ray.direction.y;
    const Vec3d p = view_ray.origin + t * view_ray.direction - drag.origin;
    if (!(t > 0)) return {};
    return std::atan2(-p.z, p.x) * (180 / pi);
  };
  const auto from = angle(drag.from), to = angle(drag.to);
  if (!from || !to) return degrees_per_unit * (drag.to.x - drag.from.x) / frame.scale;
  return std::remainder(*to - *from, 360.0);
}

std::string with_sign(double value) { return (value < 0 ? "" : "+") + format_short(value); }

/// The shift of the first object with its numbers rounded, in the frame that they are in; components that do not move
/// are left as they are.
Vec3d rounded_shift(Vec3d anchor, Vec3d shift, DragRounding drag_rounding) {
  const double minimum = 1e-9 * length(shift);
  const auto one = [&](double from, double by) {
    return std::abs(by) <= minimum ? 0.0 : without_noise(rounded(from + by, drag_rounding) - from);
  };
  return {one(anchor.x, shift.x), one(anchor.y, shift.y), one(anchor.z, shift.z)};
}

std::string move(Scene& scene, const PictureFrame& frame, const HandleDrag& drag) {
  const Vec3d axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const bool plane = drag.handle.kind == HandleKind::plane;
  const int number = static_cast<int>(drag.handle.kind) - static_cast<int>(HandleKind::along_x);
  const Vec3d axis = plane ? Vec3d{} : axes[number];
  Vec3d shift = plane ? in_plane(frame, drag.origin, drag.to) - in_plane(frame, drag.origin, drag.from)
                      : pulled(frame, drag, axis) * axis;
  if (drag.typed && !plane) shift = *drag.typed * axis;
  const Placement outer = outer_placement(scene, drag.selected.front());
  const Placement back{-outer.degrees, {}};
  const Vec3d first = anchor_of(scene, drag.selected.front());
  if (drag.moved() && !drag.typed)
    shift = rotate({outer.degrees, {}}, rounded_shift(first, rotate(back, shift), drag_rounding_of(frame, drag)));
  if (drag.moved())
    for (const ObjectPath& path : drag.selected) {
      const Placement around = outer_placement(scene, path);
      set_anchor(scene, path, without_noise(anchor_of(scene, path) + rotate({-around.degrees, {}}, shift)));
    }
  if (!plane) return std::string(1, "xyz"[number]) + " " + with_sign(without_noise(dot(shift, axis)));
  const Vec3d by = without_noise(shift);
  return fmt::format("x {}  y {}  z {}", with_sign(by.x), with_sign(by.y), with_sign(by.z));
}

std::string rotate_all(Scene& scene, const PictureFrame& frame, const HandleDrag& drag) {
  double by = drag.typed ? *drag.typed : rotated(frame, drag);
  const double step = (drag.snap ? 5 : 0.5) * (drag.fine ? 0.2 : 1);
  const double before = angle_of(scene, drag.selected.front());
  if (!drag.typed) by = without_noise(std::round((before + by) / step) * step - before);
  if (drag.moved() && by != 0)
    for (const ObjectPath& path : drag.selected) rotate_object(scene, path, by);
  return fmt::format("turned by {}°", with_sign(drag.moved() ? by : 0));
}

std::string size_up(Scene& scene, const PictureFrame& frame, const HandleDrag& drag) {
  const CameraAxes axes = axes_of(scene.camera);
  const SizeGrip grip = size_grips(scene, drag.selected.front(), normalize(axes.right - axes.up))[drag.handle.grip];
  const DragRounding drag_rounding = drag_rounding_of(frame, drag);
  if (!drag.moved()) return std::string(grip.name) + " " + format_short(grip.value);
  HandleDrag from_grip = drag;
  from_grip.origin = grip.at;
  const double value =
      drag.typed ? *drag.typed : rounded(grip.value + pulled(frame, from_grip, grip.pull), drag_rounding);
  set_size(scene, drag.selected.front(), drag.handle.grip, value, drag_rounding.size());
  const double now = size_grips(scene, drag.selected.front(), grip.pull)[drag.handle.grip].value;
  return std::string(grip.name) + " " + format_short(now);
}

// GLFW's numbers of keys.
constexpr int key_enter = 257, key_backspace = 259, key_keypad_enter = 335;
constexpr double click_distance = 4;   // units of the design; a press that goes less far is a click
constexpr double fine_fraction = 0.1;  // of the mouse's way that counts while Shift is held

}  // namespace

std::string apply_drag(Scene& scene, const PictureFrame& frame, const HandleDrag& drag) {
  if (drag.handle.kind == HandleKind::rotate) return rotate_all(scene, frame, drag);
  if (drag.handle.kind == HandleKind::size) return size_up(scene, frame, drag);
  return move(scene, frame, drag);
}

Vec3d HandleTool::origin(const Scene& scene, const PictureFrame& frame, const ObjectPaths& selected) const {
  const Vec3d middle = middle_of(scene, selected.front());
  const auto at = frame.point(middle);
  const bool seen = at && frame.image.contains(static_cast<float>(at->x), static_cast<float>(at->y));
  return !seen && clicked_ == selected.front() ? middle + click_ : middle;
}

void HandleTool::clicked(const Scene& scene, const ObjectPath& object, Vec3d point) {
  clicked_ = object;
  if (!object.empty()) click_ = point - middle_of(scene, object);
}

void HandleTool::grab(const Mouse& mouse, const ObjectPaths& selected, const Scene& scene) {
  if (selected.empty() || running_) return;
  const WindowPoint at{mouse.x, mouse.y};
  running_ = {{{}, selected, middle_of(scene, selected.front()), at, at}, scene.objects, scene.materials};
  running_->grabbed = running_->moved = true;
}

bool HandleTool::take_key(int key) {
  if (!running_) return false;
  const auto axis = static_cast<HandleKind>(static_cast<int>(HandleKind::along_x) + key - 'X');
  HandleKind& kind = running_->drag.handle.kind;
  if (running_->grabbed && key >= 'X' && key <= 'Z')
    kind = kind == axis ? HandleKind::plane : axis;  // the same key again: free once more
  else if (key == key_enter || key == key_keypad_enter)
    running_->confirmed = true;
  else if (key == key_backspace && !running_->typing.empty())
    running_->typing.pop_back();
  else
    return false;
  read_typed();
  return true;
}

bool HandleTool::take_character(char character) {
  if (!running_ || running_->drag.handle.kind == HandleKind::plane) return false;
  const std::string names = running_->typing.empty() ? "" : "pisqrt";
  if (("0123456789.,+-*/^()" + names).find(character) == std::string::npos) return false;
  running_->typing += character;
  read_typed();
  return true;
}

void HandleTool::read_typed() {
  double number = 0;
  running_->drag.typed = parse_number(running_->typing, "", number) ? std::optional(number) : std::nullopt;
}

void HandleTool::follow_mouse(const Mouse& mouse, const PictureFrame& frame, EditedScene& edited) {
  const double fraction = mouse.shift ? fine_fraction : 1.0;
  HandleDrag& drag = running_->drag;
  drag.to.x += fraction * mouse.dx;
  drag.to.y += fraction * mouse.dy;
  drag.snap = mouse.control, drag.fine = mouse.shift;
  const double moved = std::hypot(drag.to.x - drag.from.x, drag.to.y - drag.from.y);
  running_->moved = running_->moved || drag.typed || moved > click_distance * frame.scale;
  if (!running_->moved) return;
  Scene& scene = edited.change();
  scene.objects = running_->start;
  running_->said = apply_drag(scene, frame, drag);
  if (!running_->typing.empty()) running_->said += "  (typed: " + running_->typing + ")";
}

bool HandleTool::update(const Mouse& mouse, const Layout& layout, float scale, bool free, const ObjectPaths& selected,
                        EditedScene& edited) {
  const Scene& scene = *edited;
  const PictureFrame frame = frame_of(scene, layout.image, scale);
  clicked_through_ = false;
  if (waits_for_release_) return waits_for_release_ = mouse.any_down();
  if (running_ && (scene.materials != running_->materials || scene.objects.size() != running_->start.size()))
    running_.reset();  // another scene came meanwhile
  if (!running_) {
    hovered_.reset();
    if (selected.empty() || !free || !layout.area.contains(mouse.x, mouse.y)) return false;
    const Vec3d from = origin(scene, frame, selected);
    const WindowPoint at{mouse.x, mouse.y}, pressed{mouse.pressed_x[0], mouse.pressed_y[0]};
    hovered_ = handle_at(handles_of(scene, frame, selected, from), at, frame.scale);
    if (!hovered_ || !mouse.clicked[0]) return false;
    running_ = {{*hovered_, selected, from, pressed, at}, scene.objects, scene.materials};
  } else {
    follow_mouse(mouse, frame, edited);
  }
  hovered_ = running_->drag.handle;
  const bool gone = (running_->grabbed && mouse.clicked[1]) || running_->cancelled;
  if (gone) edited.change().objects = running_->start;
  const bool done = running_->confirmed || (running_->grabbed ? mouse.clicked[0] : !mouse.down[0]);
  clicked_through_ = done && !gone && !running_->moved;
  if (gone || done) {
    waits_for_release_ = mouse.any_down();
    running_.reset();
  }
  return true;
}

}  // namespace tyndall
