#include "core/compile/columns.h"

#include <cmath>

namespace tyndall {
namespace {

void set_row(Affine& map, int i, Vec3d row, Vec3d zero_at) {
  map.row[i] = to_float(row);
  map.offset[i] = static_cast<float>(-dot(row, zero_at));
}

/// Appends the elements of one shape to the columns.
struct Appender {
  const PlacedShape& shape;
  Vec3d origin;
  const MoreColumns& more;
  const Checker<>* checker;
  Elements& to;

  void append(Vec3f xyz, float inverse_radius, Vec3f move, double plane) const {
    to.x.push_back(xyz.x), to.y.push_back(xyz.y), to.z.push_back(xyz.z);
    to.inverse_radius.push_back(inverse_radius);
    if (more.motion) to.move_x.push_back(move.x), to.move_y.push_back(move.y), to.move_z.push_back(move.z);
    if (more.plane) to.plane.push_back(static_cast<float>(plane));
    to.material.push_back(shape.material);
    to.object.push_back(shape.object);
  }

  /// See Elements::plane. normal: unit; point: on the flat, in the world.
  double plane_of(Vec3d normal, Vec3d point) const {
    constexpr double near = 1e-3;  // of a cell
    const double own = dot(normal, point - origin);
    for (const auto axis : {&Vec3d::x, &Vec3d::y, &Vec3d::z}) {
      if (!checker || std::abs(normal.*axis) < 1 - 1e-12) continue;
      const double cells = point.*axis / checker->scale, border = std::round(cells);
      if (std::abs(cells - border) >= near) return own;
      const double within = std::floor(cells) < border ? border - near : border + near;
      return own + normal.*axis * (within - cells) * checker->scale;
    }
    return own;
  }

  void append_flat(Vec3d normal, Vec3d corner, Vec3d u, Vec3d v) const {
    append(to_float(normal), 0, {}, more.plane ? plane_of(normal, corner) : 0);
    if (!more.uv) return;
    const Reciprocal r = reciprocal_edges(u, v);
    for (const Vec3d row : {r.a, r.b})
      for (const double c : {row.x, row.y, row.z, -dot(row, corner - origin)}) to.uv.push_back(static_cast<float>(c));
  }
  Vec3d rotated(Vec3d direction) const { return rotate(shape.placement, direction); }
  Vec3d placed(Vec3d point) const { return place(shape.placement, point); }

  void operator()(const Sphere<>& s) const {
    const Vec3d motion = s.center_end ? *s.center_end - s.center : Vec3d{};
    append(to_float(placed(s.center) - origin), static_cast<float>(1 / s.radius), to_float(rotated(motion)), 0);
    if (!more.uv) return;
    const Vec3d x_axis = rotated({1, 0, 0});  // (cos, 0, -sin)
    for (const double c : {x_axis.x, -x_axis.z, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0}) to.uv.push_back(static_cast<float>(c));
  }
  void operator()(const Quad<>& q) const {
    const Vec3d u = rotated(q.u), v = rotated(q.v);
    append_flat(normalize(cross(u, v)), placed(q.corner), u, v);
  }
  void operator()(const Box<>& b) const {
    for (std::int32_t i = 0; i < 6; ++i) {
      const BoxFace face = box_face_edges(b, i);
      append_flat(rotated(face.normal), placed(face.corner), rotated(face.u), rotated(face.v));
    }
  }
};

}  // namespace

Reciprocal reciprocal_edges(Vec3d u, Vec3d v) {
  const Vec3d n = cross(u, v);
  const double squared = dot(n, n);
  return {(1 / squared) * cross(v, n), (1 / squared) * cross(n, u)};
}

/// Corners and edges are those of the box in The Next Week, section 8.1.
BoxFace box_face_edges(const Box<>& b, std::int32_t face) {
  const Vec3d d = b.max - b.min, dx{d.x, 0, 0}, dy{0, d.y, 0}, dz{0, 0, d.z};
  switch (face) {
    case 0:
      return {{-1, 0, 0}, b.min, dz, dy};
    case 1:
      return {{1, 0, 0}, {b.max.x, b.min.y, b.max.z}, -dz, dy};
    case 2:
      return {{0, -1, 0}, b.min, dx, dz};
    case 3:
      return {{0, 1, 0}, {b.min.x, b.max.y, b.max.z}, dx, -dz};
    case 4:
      return {{0, 0, -1}, {b.max.x, b.min.y, b.min.z}, -dx, dy};
    default:
      return {{0, 0, 1}, {b.min.x, b.min.y, b.max.z}, dx, dy};
  }
}

Affine quad_map(const Quad<>& quad, const Placement& placement, Vec3d origin) {
  const Vec3d u = rotate(placement, quad.u), v = rotate(placement, quad.v);
  const Vec3d middle = place(placement, quad.corner) - origin + 0.5 * (u + v);
  const Reciprocal r = reciprocal_edges(u, v);
  Affine map;
  set_row(map, 0, 2.0 * r.a, middle);
  set_row(map, 1, 2.0 * r.b, middle);
  set_row(map, 2, normalize(cross(u, v)), middle);
  return map;
}

Affine box_map(const Box<>& box, const Placement& placement, Vec3d origin) {
  const Vec3d middle = place(placement, 0.5 * box.min + 0.5 * box.max) - origin, size = box.max - box.min;
  Affine map;
  set_row(map, 0, (2 / size.x) * rotate(placement, {1, 0, 0}), middle);
  set_row(map, 1, (2 / size.y) * rotate(placement, {0, 1, 0}), middle);
  set_row(map, 2, (2 / size.z) * rotate(placement, {0, 0, 1}), middle);
  return map;
}

void append_elements(const PlacedShape& shape, Vec3d origin, const MoreColumns& more, const Checker<>* checker,
                     Elements& elements) {
  std::visit(Appender{shape, origin, more, checker, elements}, shape.shape);
}

}  // namespace tyndall
