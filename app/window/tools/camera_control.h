#pragma once
#include "core/scene/scene.h"

#include <set>

/// Mouse and keys to cameras, and flying through the scene with W, A, S, D, Q and E. The functions are pure: a camera
/// goes in, a camera comes out. All keep the camera valid (a direction, not parallel to vup) and round it to six digits
/// of its distance, so that saved files stay readable. And how all numbers are rounded that the mouse changes.
namespace tyndall {

/// A step that numbers are rounded to: multiple * 10^exponent, multiple being 1, 2 or 5.
struct DragRounding {
  int multiple = 1, exponent = 0;
  double size() const;
};
/// The largest power of ten that is at most `size` > 0.
DragRounding decimal_below(double size);
/// The largest of 1, 2 or 5 times a power of ten that is at most `size` > 0.
DragRounding nice_below(double size);

/// The multiple of the grain that is nearest; it prints short.
double rounded(double value, DragRounding drag_rounding);
Vec3d rounded(Vec3d v, DragRounding drag_rounding);
/// Twelve significant digits: 0.1 + 0.2 becomes 0.3.
double without_noise(double value);
Vec3d without_noise(Vec3d v);

/// The camera's own axes, unit: to the right, up in the picture, and forward.
struct CameraAxes {
  Vec3d right, up, forward;
};
CameraAxes axes_of(const Camera& camera);

/// Distance from look_from to look_at.
double target_distance(const Camera& camera);
/// Distance of the plane in focus along the axis.
double focus_distance(const Camera& camera);

/// Turns the eye around look_at: yaw about vup, pitch about the horizontal, in radians; positive: the scene follows the
/// mouse to the right, or down. Stops one degree short of the poles.
Camera orbit(const Camera& camera, double yaw, double pitch);
/// Moves eye and target together; right, up: in heights of the picture at the target's distance.
Camera pan(const Camera& camera, double right, double up);
/// Scales the distance of the eye from the target by factor > 0; not nearer or farther than numbers can tell.
Camera dolly(const Camera& camera, double factor);
/// Opens the field of view: scales the tangent of half of it by factor > 0. Stays within 0.1 and 170 degrees.
Camera zoom(const Camera& camera, double factor);
/// Moves eye and target together along the camera's axes, scene units.
Camera fly(const Camera& camera, double right, double up, double forward);
/// Puts the plane in focus at `depth` > 0 along the axis. The lens stays as it is, so the defocus angle follows;
/// keep_blur: the angle stays, and with it the blur of what is far away.
Camera focus(const Camera& camera, double depth, bool keep_blur);
/// Looks at a sphere from the same direction and from so far that it fills the picture. aspect: width over height.
Camera frame_sphere(const Camera& camera, Vec3d center, double radius, double aspect);

/// A point in the camera's frame: right, up, and depth along the axis.
Vec3d in_camera_frame(const Camera& camera, Vec3d point);

/// Flies the camera while keys are held.
class Flight {
 public:
  /// To be called in each drawing; changes the camera. held: keys, by GLFW's numbers; with Shift it is four times as
  /// fast. Keys that are let go in the very next drawing have flown for `tap` seconds. Returns whether it flies: then
  /// the window is to be drawn again soon.
  bool update(const std::set<int>& held, double now, Camera& camera);

 private:
  static constexpr double tap = 1 / 60.0;

  double last_ = -1;    ///< second of the last drawing in flight; < 0: it does not fly
  Vec3d heading_;       ///< where it flew to then: right, up, forward
  bool moved_ = false;  ///< the camera has moved in this flight
};

/// Whether a key of flight is among these.
bool holds_fly_key(const std::set<int>& held);

}  // namespace tyndall
