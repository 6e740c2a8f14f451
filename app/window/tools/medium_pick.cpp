#include "app/window/tools/medium_pick.h"

#include "app/window/tools/camera_control.h"
#include "core/base/math.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tyndall {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// Distance at which a ray enters the shape from outside; `never` if it does not. direction: unit.
double entry(const Sphere<>& sphere, Vec3d origin, Vec3d direction) {
  const Interval<double> line = sphere_interval(sphere.center - origin, sphere.radius, direction);
  return line.hit && line.near > 0 ? line.near : never;
}

double entry(const Box<>& box, Vec3d origin, Vec3d direction) {
  double near = -never, far = never;
  const auto slab = [&](double low, double high, double from, double along_axis) {
    double a = (low - from) / along_axis, b = (high - from) / along_axis;
    if (a > b) std::swap(a, b);
    near = std::max(near, a), far = std::min(far, b);
  };
  slab(box.min.x, box.max.x, origin.x, direction.x);
  slab(box.min.y, box.max.y, origin.y, direction.y);
  slab(box.min.z, box.max.z, origin.z, direction.z);
  return near <= far && near > 0 ? near : never;
}

}  // namespace

ObjectPath medium_at(const Scene& scene, ImagePoint at, double depth) {
  const CameraAxes axes = axes_of(scene.camera);
  const double height = std::tan(scene.camera.vfov * (pi / 360)), width = height * scene.width / scene.height;
  const double x = (2 * at.x - 1) * width, y = (1 - 2 * at.y) * height;
  const Vec3d direction = normalize(x * axes.right + y * axes.up + axes.forward);
  double nearest = depth / dot(direction, axes.forward);
  ObjectPath found;
  for (const ObjectPath& path : leaves(scene)) {
    const Volume* volume = std::get_if<Volume>(&find_object(scene, path)->kind);
    if (!volume) continue;
    const Placement placed = placement_at(scene, path);
    const Placement back{-placed.degrees, {}};
    const Vec3d origin = turn(back, scene.camera.look_from - placed.offset), way = turn(back, direction);
    const double enters = std::visit([&](const auto& shape) { return entry(shape, origin, way); }, volume->boundary);
    if (enters < nearest) nearest = enters, found = path;
  }
  return found;
}

}  // namespace tyndall
