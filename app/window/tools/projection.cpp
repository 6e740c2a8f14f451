#include "app/window/tools/projection.h"

#include "app/window/tools/camera_control.h"
#include "core/base/math.h"
#include "core/shapes/outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace tyndall {
namespace {

constexpr int circle_points = 96;
constexpr std::size_t max_lines = 4000;

/// Turns lines in space into lines of the image.
struct Projector {
  Projection projection;
  std::vector<ImageLine> lines{};

  void add(Vec3d from, Vec3d to) {
    const auto line = projection.line(from, to);
    if (line && lines.size() < max_lines) lines.push_back(*line);
  }
};

/// The circle where lines from the eye touch the sphere.
void add_shape(Projector& out, const Sphere<>& sphere, const Placement& at) {
  const Vec3d center = place(at, sphere.center), to_eye = out.projection.camera.look_from - center;
  const double distance2 = dot(to_eye, to_eye), radius2 = sphere.radius * sphere.radius;
  if (distance2 <= radius2) return;
  const Vec3d middle = center + (radius2 / distance2) * to_eye;
  const double around = std::abs(sphere.radius) * std::sqrt(1 - radius2 / distance2);
  const Basis<double> basis = basis_around(normalize(to_eye));
  const auto point = [&](int k) {
    const double angle = 2 * pi * k / circle_points;
    return middle + (around * std::cos(angle)) * basis.s + (around * std::sin(angle)) * basis.t;
  };
  for (int k = 0; k < circle_points; ++k) out.add(point(k), point(k + 1));
}

void add_shape(Projector& out, const Quad<>& quad, const Placement& at) {
  const std::array<Vec3d, 4> p{place(at, quad.corner), place(at, quad.corner + quad.u),
                               place(at, quad.corner + quad.u + quad.v), place(at, quad.corner + quad.v)};
  for (std::size_t k = 0; k < 4; ++k) out.add(p[k], p[(k + 1) % 4]);
}

void add_shape(Projector& out, const Triangle<>& triangle, const Placement& at) {
  const std::array<Vec3d, 3> p{place(at, triangle.corner), place(at, triangle.corner + triangle.u),
                               place(at, triangle.corner + triangle.v)};
  for (std::size_t k = 0; k < 3; ++k) out.add(p[k], p[(k + 1) % 3]);
}

void add_shape(Projector& out, const Disk<>& disk, const Placement& at) {
  const auto point = [&](int k, double radius) {
    const double angle = 2 * pi * k / circle_points;
    return place(at, disk.center + (radius * std::cos(angle)) * disk.u + (radius * std::sin(angle)) * disk.v);
  };
  for (const double radius : {1.0, disk.inner})
    for (int k = 0; radius > 0 && k < circle_points; ++k) out.add(point(k, radius), point(k + 1, radius));
}

/// An edge belongs to the silhouette when the eye is in front of one of its two faces only.
void add_shape(Projector& out, const Box<>& box, const Placement& at) {
  const double low[3] = {box.min.x, box.min.y, box.min.z}, high[3] = {box.max.x, box.max.y, box.max.z};
  const Vec3d centre = place(at, {0, 0, 0});
  const Vec3d rows[3] = {rotate(at, {1, 0, 0}), rotate(at, {0, 1, 0}), rotate(at, {0, 0, 1})};
  const auto in_front = [&](int axis, bool plus) {
    const double eye = dot(out.projection.camera.look_from - centre, rows[axis]);
    return plus ? eye > high[axis] : eye < low[axis];
  };
  for (int axis = 0; axis < 3; ++axis)
    for (int corner = 0; corner < 4; ++corner) {
      const int b = (axis + 1) % 3, c = (axis + 2) % 3;
      const bool plus_b = corner & 1, plus_c = corner & 2;
      if (in_front(b, plus_b) == in_front(c, plus_c)) continue;
      double from[3], to[3];
      from[axis] = low[axis], to[axis] = high[axis];
      from[b] = to[b] = plus_b ? high[b] : low[b];
      from[c] = to[c] = plus_c ? high[c] : low[c];
      out.add(place(at, {from[0], from[1], from[2]}), place(at, {to[0], to[1], to[2]}));
    }
}

void add_object(Projector& out, const Scene& scene, const ObjectPath& path) {
  const Object* object = find_object(scene, path);
  if (!object || out.lines.size() >= max_lines) return;
  if (const Group* group = std::get_if<Group>(&object->kind)) {
    ObjectPath child = path;
    for (child.push_back(0); child.back() < static_cast<int>(group->objects.size()); ++child.back())
      add_object(out, scene, child);
    return;
  }
  const Placement at = placement_at(scene, path);
  with_shape(*object, [&](const auto& shape) { add_shape(out, shape, at); });
}

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
  for (const auto axis : {&Vec3d::x, &Vec3d::y, &Vec3d::z}) {
    const double from = view_ray.origin.*axis, along_axis = view_ray.direction.*axis;
    double a = (box.min.*axis - from) / along_axis, b = (box.max.*axis - from) / along_axis;
    if (a > b) std::swap(a, b);
    near = std::max(near, a), far = std::min(far, b);
  }
  return near <= far ? Crossing{near, far} : Crossing{};
}

/// Where a line meets the plane of a parallelogram, and there the fractions a and b of its edges.
struct PlanePoint {
  double t, a, b;
};
PlanePoint on_plane(const Quad<>& quad, const ViewRay& view_ray) {
  const Vec3d normal = cross(quad.u, quad.v);
  const double t = dot(normal, quad.corner - view_ray.origin) / dot(normal, view_ray.direction);
  const Vec3d p = view_ray.origin + t * view_ray.direction - quad.corner;
  const double square = dot(normal, normal);
  return {t, dot(cross(p, quad.v), normal) / square, dot(cross(quad.u, p), normal) / square};
}

Crossing crossing(const Quad<>& quad, const ViewRay& view_ray) {
  const auto [t, a, b] = on_plane(quad, view_ray);
  const bool inside = a >= 0 && a <= 1 && b >= 0 && b <= 1;  // false for what is not a number
  return inside ? Crossing{t, t} : Crossing{};
}

template <class Shape>
requires has_outline<Shape> Crossing crossing(const Shape& shape, const ViewRay& view_ray) {
  const PlanePoint at = on_plane(frame_of(shape), view_ray);
  return within(outline_of(shape), 2 * at.a - 1, 2 * at.b - 1) ? Crossing{at.t, at.t} : Crossing{};
}

/// Where the object begins along the line of sight, at a distance above 0; `never`: nowhere.
double begins_at(const Object& object, const ViewRay& view_ray) {
  Crossing c;
  with_shape(object, [&](const auto& shape) { c = crossing(shape, view_ray); });
  const bool from_within = c.far > 0 && std::holds_alternative<Solid3d>(object.kind);
  return c.near > 0 ? c.near : from_within ? c.far : never;
}

}  // namespace

Projection::Projection(const Scene& scene)
    : camera(scene.camera),
      height_(2 * std::tan(scene.camera.vfov * (pi / 360))),
      width_(height_ * scene.width / scene.height),
      near_(1e-3 * target_distance(scene.camera)) {}

ImagePoint Projection::seen(Vec3d p) const { return {0.5 + p.x / (p.z * width_), 0.5 - p.y / (p.z * height_)}; }

std::optional<ImagePoint> Projection::point(Vec3d p) const {
  const Vec3d in_frame = in_camera_frame(camera, p);
  if (in_frame.z < near_) return {};
  return seen(in_frame);
}

std::optional<ImageLine> Projection::line(Vec3d from, Vec3d to) const {
  Vec3d a = in_camera_frame(camera, from), b = in_camera_frame(camera, to);
  if (a.z < near_ && b.z < near_) return {};
  const auto cut = [&](Vec3d behind, Vec3d ahead) {
    return behind + ((near_ - behind.z) / (ahead.z - behind.z)) * (ahead - behind);
  };
  if (a.z < near_) a = cut(a, b);
  if (b.z < near_) b = cut(b, a);
  return ImageLine{seen(a), seen(b)};
}

ViewRay Projection::view_ray(ImagePoint at) const {
  const CameraAxes axes = axes_of(camera);
  const double x = (at.x - 0.5) * width_, y = (0.5 - at.y) * height_;
  return {camera.look_from, normalize(x * axes.right + y * axes.up + axes.forward)};
}

double Projection::depth_of(Vec3d p) const { return in_camera_frame(camera, p).z; }

std::vector<ImageLine> outline(const Scene& scene, const ObjectPath& path) {
  Projector out{Projection(scene)};
  add_object(out, scene, path);
  return std::move(out.lines);
}

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
