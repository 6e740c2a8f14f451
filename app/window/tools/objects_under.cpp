#include "app/window/tools/objects_under.h"

#include "core/base/math.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tyndall {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// Distances at which a line enters and leaves a shape; near = never: it misses.
struct Crossing {
  double near = never, far = never;
};

Crossing crossing(const Sphere<>& sphere, const ViewRay& view_ray) {
  const Interval<double> line =
      sphere_interval(sphere.center - view_ray.origin, std::abs(sphere.radius), view_ray.direction);
  return line.hit ? Crossing{line.near, line.far} : Crossing{};
}

Crossing crossing(const Box<>& box, const ViewRay& view_ray) {
  double near = -never, far = never;
  const auto slab = [&](double low, double high, double from, double along_axis) {
    double a = (low - from) / along_axis, b = (high - from) / along_axis;
    if (a > b) std::swap(a, b);
    near = std::max(near, a), far = std::min(far, b);
  };
  slab(box.min.x, box.max.x, view_ray.origin.x, view_ray.direction.x);
  slab(box.min.y, box.max.y, view_ray.origin.y, view_ray.direction.y);
  slab(box.min.z, box.max.z, view_ray.origin.z, view_ray.direction.z);
  return near <= far ? Crossing{near, far} : Crossing{};
}

Crossing crossing(const Quad<>& quad, const ViewRay& view_ray) {
  const Vec3d normal = cross(quad.u, quad.v);
  const double t = dot(normal, quad.corner - view_ray.origin) / dot(normal, view_ray.direction);
  const Vec3d p = view_ray.origin + t * view_ray.direction - quad.corner;
  const double square = dot(normal, normal), a = dot(cross(p, quad.v), normal) / square,
               b = dot(cross(quad.u, p), normal) / square;
  const bool inside = a >= 0 && a <= 1 && b >= 0 && b <= 1;  // false for what is not a number
  return inside ? Crossing{t, t} : Crossing{};
}

/// Where the object begins along the line of sight, at a distance above 0; `never`: nowhere.
double begins_at(const Object& object, const ViewRay& view_ray) {
  Crossing c;
  with_shape(object, [&](const auto& shape) { c = crossing(shape, view_ray); });
  const bool from_within = c.far > 0 && std::holds_alternative<Solid3d>(object.kind);
  return c.near > 0 ? c.near : from_within ? c.far : never;
}

}  // namespace

std::vector<ObjectUnder> objects_under(const Scene& scene, ImagePoint at) {
  const ViewRay view_ray = Projection(scene).view_ray(at);
  std::vector<ObjectUnder> found;
  for (const ObjectPath& path : leaves(scene)) {
    const Object& object = *find_object(scene, path);
    const Placement placed = placement_at(scene, path);
    const Placement back{-placed.degrees, {}};
    const ViewRay own{rotate(back, view_ray.origin - placed.offset), rotate(back, view_ray.direction)};
    const double distance = begins_at(object, own);
    if (distance < never) found.push_back({path, distance, std::holds_alternative<Volume>(object.kind)});
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const ObjectUnder& a, const ObjectUnder& b) { return a.distance < b.distance; });
  return found;
}

}  // namespace tyndall
