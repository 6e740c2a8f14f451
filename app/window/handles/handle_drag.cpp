#include "app/window/handles/handle_drag.h"

#include "app/text/numbers.h"
#include "app/window/edit/arrange.h"
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
Grain grain_of(const PictureFrame& frame, const HandleDrag& drag) {
  const double unit = frame.unit_at(drag.origin), height = static_cast<double>(frame.image.height());
  Grain grain = drag.snap ? nice_below(unit * height / snaps_in_picture) : decimal_below(unit);
  if (drag.fine) --grain.exponent;
  return grain;
}

/// Where the line of sight through a place of the window meets the plane through the origin that faces the camera.
Vec3d in_plane(const PictureFrame& frame, Vec3d origin, WindowPoint at) {
  const Sight sight = frame.sight(at);
  const Vec3d forward = axes_of(frame.projection.camera()).forward;
  const double least = 1e-3 * target_distance(frame.projection.camera());
  const double depth = std::max(dot(origin - sight.origin, forward), least);
  return sight.origin + (depth / dot(sight.direction, forward)) * sight.direction;
}

/// How far along a line through the origin the point is that is nearest to the line of sight.
double along_line(const PictureFrame& frame, Vec3d origin, Vec3d way, WindowPoint at) {
  const Sight sight = frame.sight(at);
  const Vec3d between = origin - sight.origin;
  const double cosine = dot(way, sight.direction), sine2 = 1 - cosine * cosine;
  if (sine2 < 1e-6) return 0;
  return (cosine * dot(sight.direction, between) - dot(way, between)) / sine2;
}

/// How far the mouse has pulled along a way. On one that is seen from its end the mouse cannot stay at what it has
/// taken, because a few pixels would lead to the horizon: there it pulls by a multiple of its own way instead.
double pulled(const PictureFrame& frame, const HandleDrag& drag, Vec3d way) {
  const WindowPoint seen = frame.seen_way(drag.origin, way);
  if (const double share = std::hypot(seen.x, seen.y); share < PictureFrame::least_followed) {
    const double along = (drag.to.x - drag.from.x) * seen.x + (drag.to.y - drag.from.y) * seen.y;
    return frame.unit_at(drag.origin) / PictureFrame::least_followed * along / std::max(share, 1e-6);
  }
  return along_line(frame, drag.origin, way, drag.to) - along_line(frame, drag.origin, way, drag.from);
}

/// Degrees that the mouse has turned around the vertical through the origin.
double turned(const PictureFrame& frame, const HandleDrag& drag) {
  const auto angle = [&](WindowPoint at) -> std::optional<double> {
    const Sight sight = frame.sight(at);
    if (std::abs(sight.direction.y) < 0.15) return {};
    const double t = (drag.origin.y - sight.origin.y) / sight.direction.y;
    const Vec3d p = sight.origin + t * sight.direction - drag.origin;
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
Vec3d rounded_shift(Vec3d anchor, Vec3d shift, Grain grain) {
  const double least = 1e-9 * length(shift);
  const auto one = [&](double from, double by) {
    return std::abs(by) <= least ? 0.0 : without_noise(rounded(from + by, grain) - from);
  };
  return {one(anchor.x, shift.x), one(anchor.y, shift.y), one(anchor.z, shift.z)};
}

DragResult move(Scene& scene, const PictureFrame& frame, const HandleDrag& drag) {
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
  const bool moved = drag.typed || drag.to.x != drag.from.x || drag.to.y != drag.from.y;
  if (moved && !drag.typed)
    shift = turn({outer.degrees, {}}, rounded_shift(first, turn(back, shift), grain_of(frame, drag)));
  if (moved)
    for (const ObjectPath& path : drag.selected) {
      const Placement around = outer_placement(scene, path);
      set_anchor(scene, path, without_noise(anchor_of(scene, path) + turn({-around.degrees, {}}, shift)));
    }
  if (!plane) return {shift, std::string(1, "xyz"[number]) + " " + with_sign(without_noise(dot(shift, axis)))};
  return {shift, fmt::format("x {}  y {}  z {}", with_sign(without_noise(shift.x)), with_sign(without_noise(shift.y)),
                             with_sign(without_noise(shift.z)))};
}

DragResult turn_all(Scene& scene, const PictureFrame& frame, const HandleDrag& drag) {
  double by = drag.typed ? *drag.typed : turned(frame, drag);
  const double step = (drag.snap ? 5 : 0.5) * (drag.fine ? 0.2 : 1);
  const double before = angle_of(scene, drag.selected.front());
  if (!drag.typed) by = without_noise(std::round((before + by) / step) * step - before);
  const bool moved = drag.typed || drag.to.x != drag.from.x || drag.to.y != drag.from.y;
  if (moved && by != 0)
    for (const ObjectPath& path : drag.selected) turn_object(scene, path, by);
  return {{}, fmt::format("turned by {}°", with_sign(moved ? by : 0))};
}

DragResult size_up(Scene& scene, const PictureFrame& frame, const HandleDrag& drag) {
  const CameraAxes axes = axes_of(scene.camera);
  const SizeGrip grip = size_grips(scene, drag.selected.front(), normalize(axes.right - axes.up))[drag.handle.grip];
  const Grain grain = grain_of(frame, drag);
  const bool moved = drag.typed || drag.to.x != drag.from.x || drag.to.y != drag.from.y;
  if (!moved) return {{}, std::string(grip.name) + " " + format_short(grip.value)};
  HandleDrag from_grip = drag;
  from_grip.origin = grip.at;
  const double value = drag.typed ? *drag.typed : rounded(grip.value + pulled(frame, from_grip, grip.way), grain);
  set_size(scene, drag.selected.front(), drag.handle.grip, value, grain.size());
  const double now = size_grips(scene, drag.selected.front(), grip.way)[drag.handle.grip].value;
  return {{}, std::string(grip.name) + " " + format_short(now)};
}

}  // namespace

DragResult apply_drag(Scene& scene, const PictureFrame& frame, const HandleDrag& drag) {
  if (drag.handle.kind == HandleKind::turn) return turn_all(scene, frame, drag);
  if (drag.handle.kind == HandleKind::size) return size_up(scene, frame, drag);
  return move(scene, frame, drag);
}

}  // namespace tyndall
