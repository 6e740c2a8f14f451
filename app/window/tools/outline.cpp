#include "app/window/tools/outline.h"

#include "core/base/math.h"

#include <array>
#include <cmath>

namespace tyndall {
namespace {

constexpr int circle_points = 96;
constexpr std::size_t max_lines = 4000;

/// Turns lines in space into lines of the image.
class Projector {
 public:
  explicit Projector(const Scene& scene) : projection_(scene) {}

  void add(Vec3d from, Vec3d to) {
    const auto line = projection_.line(from, to);
    if (line && lines.size() < max_lines) lines.push_back(*line);
  }
  Vec3d eye() const { return projection_.camera().look_from; }

  std::vector<ImageLine> lines;

 private:
  Projection projection_;
};

/// The circle where lines from the eye touch the sphere.
void add_sphere(Projector& out, Vec3d center, double radius) {
  const Vec3d to_eye = out.eye() - center;
  const double distance2 = dot(to_eye, to_eye), radius2 = radius * radius;
  if (distance2 <= radius2) return;
  const Vec3d middle = center + (radius2 / distance2) * to_eye;
  const double around = std::abs(radius) * std::sqrt(1 - radius2 / distance2);
  const Basis<double> basis = basis_around(normalize(to_eye));
  const auto point = [&](int k) {
    const double angle = 2 * pi * k / circle_points;
    return middle + (around * std::cos(angle)) * basis.s + (around * std::sin(angle)) * basis.t;
  };
  for (int k = 0; k < circle_points; ++k) out.add(point(k), point(k + 1));
}

void add_shape(Projector& out, const Sphere<>& sphere, const Placement& at) {
  add_sphere(out, place(at, sphere.center), sphere.radius);
}

void add_shape(Projector& out, const Quad<>& quad, const Placement& at) {
  const std::array<Vec3d, 4> p{place(at, quad.corner), place(at, quad.corner + quad.u),
                               place(at, quad.corner + quad.u + quad.v), place(at, quad.corner + quad.v)};
  for (std::size_t k = 0; k < 4; ++k) out.add(p[k], p[(k + 1) % 4]);
}

/// An edge belongs to the silhouette when the eye is in front of one of its two faces only.
void add_shape(Projector& out, const Box<>& box, const Placement& at) {
  const double low[3] = {box.min.x, box.min.y, box.min.z}, high[3] = {box.max.x, box.max.y, box.max.z};
  const Vec3d centre = place(at, {0, 0, 0});
  const Vec3d rows[3] = {rotate(at, {1, 0, 0}), rotate(at, {0, 1, 0}), rotate(at, {0, 0, 1})};
  const auto in_front = [&](int axis, bool plus) {
    const double eye = dot(out.eye() - centre, rows[axis]);
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

}  // namespace

std::vector<ImageLine> outline(const Scene& scene, const ObjectPath& path) {
  Projector out(scene);
  add_object(out, scene, path);
  return std::move(out.lines);
}

}  // namespace tyndall
