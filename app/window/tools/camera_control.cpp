#include "app/window/tools/camera_control.h"

#include "core/base/math.h"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace tyndall {
namespace {

constexpr double degree = pi / 180;
constexpr int left_shift = 340, right_shift = 344;  // GLFW's numbers

constexpr int min_exponent = -300, max_exponent = 300;  // where powers of ten are numbers

/// To six digits of `size` > 0, so that saved files stay readable.
DragRounding six_digits_of(double size) { return {1, decimal_below(size).exponent - 5}; }

Camera tidy(Camera camera) {
  const DragRounding drag_rounding = six_digits_of(target_distance(camera));
  camera.look_from = rounded(camera.look_from, drag_rounding);
  camera.look_at = rounded(camera.look_at, drag_rounding);
  return camera;
}

/// v turned about the unit axis by an angle in radians (Rodrigues' formula).
Vec3d rotated(Vec3d v, Vec3d axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return c * v + s * cross(axis, v) + ((1 - c) * dot(axis, v)) * axis;
}

double half_tangent(const Camera& camera) { return std::tan(0.5 * degree * camera.vfov); }

}  // namespace

double DragRounding::size() const { return multiple * std::pow(10.0, exponent); }

DragRounding decimal_below(double size) {
  const double exponent = std::floor(std::log10(size) + 1e-9);
  return {1, static_cast<int>(std::fmin(std::fmax(exponent, min_exponent), max_exponent))};
}

DragRounding nice_below(double size) {
  DragRounding drag_rounding = decimal_below(size);
  for (const int multiple : {2, 5})
    if (multiple * std::pow(10.0, drag_rounding.exponent) <= size * (1 + 1e-9)) drag_rounding.multiple = multiple;
  return drag_rounding;
}

double rounded(double value, DragRounding drag_rounding) {
  // Grains below 1 divide by a power of ten, which is exact: the result prints short.
  if (drag_rounding.exponent < 0) {
    const double per_unit = std::pow(10.0, -drag_rounding.exponent);
    return std::round(value * per_unit / drag_rounding.multiple) * drag_rounding.multiple / per_unit + 0.0;
  }
  return std::round(value / drag_rounding.size()) * drag_rounding.size() + 0.0;
}

Vec3d rounded(Vec3d v, DragRounding drag_rounding) {
  return {rounded(v.x, drag_rounding), rounded(v.y, drag_rounding), rounded(v.z, drag_rounding)};
}

double without_noise(double value) {
  if (value == 0 || !std::isfinite(value)) return value;
  return rounded(value, {1, decimal_below(std::abs(value)).exponent - 11});
}

Vec3d without_noise(Vec3d v) { return {without_noise(v.x), without_noise(v.y), without_noise(v.z)}; }

CameraAxes axes_of(const Camera& camera) {
  const Vec3d forward = normalize(camera.look_at - camera.look_from);
  const Vec3d right = normalize(cross(forward, camera.vup));
  return {right, cross(right, forward), forward};
}

double target_distance(const Camera& camera) { return length(camera.look_at - camera.look_from); }

double focus_distance(const Camera& camera) { return camera.focus_distance.value_or(target_distance(camera)); }

Camera orbit(const Camera& camera, double yaw, double pitch) {
  const Vec3d pole = normalize(camera.vup);
  const CameraAxes axes = axes_of(camera);
  Vec3d eye = camera.look_from - camera.look_at;
  const double from_pole = std::acos(std::clamp(dot(normalize(eye), pole), -1.0, 1.0));
  const double wanted = std::clamp(from_pole - pitch, degree, pi - degree);
  // The eye itself may start closer to a pole than it may be turned to.
  const double allowed = pitch == 0 ? 0.0 : from_pole - wanted;
  eye = rotated(rotated(eye, axes.right, -allowed), pole, -yaw);
  Camera result = camera;
  result.look_from = camera.look_at + eye;
  return tidy(result);
}

Camera pan(const Camera& camera, double right, double up) {
  const double height = 2 * half_tangent(camera) * target_distance(camera);
  return fly(camera, right * height, up * height, 0);
}

Camera dolly(const Camera& camera, double factor) {
  Camera result = camera;
  result.look_from = camera.look_at + factor * (camera.look_from - camera.look_at);
  const double distance = target_distance(result), minimum = 1e-9 * std::max(1.0, length(camera.look_at)),
               maximum = 1e12;
  if (distance < minimum || distance > maximum) return camera;
  return tidy(result);
}

Camera zoom(const Camera& camera, double factor) {
  Camera result = camera;
  const double wanted = 2 / degree * std::atan(factor * half_tangent(camera));
  const double limited =
      factor > 1 ? std::min(wanted, std::max(170.0, camera.vfov)) : std::max(wanted, std::min(0.1, camera.vfov));
  result.vfov = std::round(limited * 1e4) / 1e4;
  return result;
}

Camera fly(const Camera& camera, double right, double up, double forward) {
  const CameraAxes axes = axes_of(camera);
  const Vec3d step = right * axes.right + up * axes.up + forward * axes.forward;
  Camera result = camera;
  result.look_from = camera.look_from + step;
  result.look_at = camera.look_at + step;
  return tidy(result);
}

Camera focus(const Camera& camera, double depth, bool keep_blur) {
  Camera result = camera;
  result.focus_distance = rounded(depth, six_digits_of(depth));
  if (!keep_blur && camera.defocus_angle > 0) {
    const double lens = focus_distance(camera) * std::tan(0.5 * degree * camera.defocus_angle);
    result.defocus_angle = rounded(2 / degree * std::atan(lens / depth), six_digits_of(camera.defocus_angle));
  }
  return result;
}

Camera frame_sphere(const Camera& camera, Vec3d center, double radius, double aspect) {
  const double tangent = half_tangent(camera) * std::min(1.0, aspect);
  const double distance = 1.15 * radius * std::sqrt(1 + 1 / (tangent * tangent));
  const Vec3d forward = axes_of(camera).forward;
  Camera result = camera;
  result.look_at = center;
  result.look_from = center - distance * forward;
  return tidy(result);
}

Vec3d in_camera_frame(const Camera& camera, Vec3d point) {
  const CameraAxes axes = axes_of(camera);
  const Vec3d v = point - camera.look_from;
  return {dot(v, axes.right), dot(v, axes.up), dot(v, axes.forward)};
}

bool holds_fly_key(const std::set<int>& held) {
  constexpr std::string_view keys = "WASDQE";
  return std::any_of(keys.begin(), keys.end(), [&](int key) { return held.contains(key); });
}

bool Flight::update(const std::set<int>& held, double now, Camera& camera) {
  const auto part = [&](int ahead, int back) -> double { return held.contains(ahead) - held.contains(back); };
  const Vec3d heading{part('D', 'A'), part('E', 'Q'), part('W', 'S')};
  const bool fast = held.contains(left_shift) || held.contains(right_shift);
  const bool flies = !(heading == Vec3d{}), tapped = !flies && last_ >= 0 && !moved_;
  const double seconds = tapped ? tap : flies && last_ >= 0 ? std::min(now - last_, 0.1) : 0;
  if (seconds > 0) {
    const double speed = (fast ? 3.0 : 0.75) * target_distance(camera);  // scene units a second
    const Vec3d step = seconds * speed * (tapped ? heading_ : heading);
    camera = fly(camera, step.x, step.y, step.z);
  }
  moved_ = flies && last_ >= 0;
  heading_ = heading;
  last_ = flies ? now : -1;
  return flies;
}

}  // namespace tyndall
