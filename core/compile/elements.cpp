#include "core/compile/columns.h"

#include <cmath>

namespace tyndall {
namespace {

void set_row(Affine& map, int i, Vec3d row, Vec3d zero_at) {
  map.row[i] = to_float(row);
  map.offset[i] = static_cast<float>(-dot(row, zero_at));
}

void append(Elements& e, Vec3f xyz, float inverse_radius, Vec3f move, bool motion, const PlacedShape& shape) {
  e.x.push_back(xyz.x), e.y.push_back(xyz.y), e.z.push_back(xyz.z);
  e.inverse_radius.push_back(inverse_radius);
  if (motion) e.move_x.push_back(move.x), e.move_y.push_back(move.y), e.move_z.push_back(move.z);
  e.material.push_back(shape.material);
  e.object.push_back(shape.object);
}

void append_flat_uv(Elements& e, Vec3d corner, Vec3d u, Vec3d v) {
  const Reciprocal r = reciprocal_edges(u, v);
  for (const Vec3d row : {r.a, r.b})
    for (const double c : {row.x, row.y, row.z, -dot(row, corner)}) e.uv.push_back(static_cast<float>(c));
}

void append_shape(const Sphere<>& s, const PlacedShape& shape, Vec3d origin, bool uv, bool motion, Elements& e) {
  const Vec3d way = s.center_end ? *s.center_end - s.center : Vec3d{};
  append(e, to_float(place(shape.placement, s.center) - origin), static_cast<float>(1 / s.radius),
         to_float(turn(shape.placement, way)), motion, shape);
  if (!uv) return;
  const Vec3d x_axis = turn(shape.placement, {1, 0, 0});  // (cos, 0, -sin)
  for (const double c : {x_axis.x, -x_axis.z, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0}) e.uv.push_back(static_cast<float>(c));
}

void append_shape(const Quad<>& q, const PlacedShape& shape, Vec3d origin, bool uv, bool motion, Elements& e) {
  const Vec3d u = turn(shape.placement, q.u), v = turn(shape.placement, q.v);
  append(e, to_float(normalize(cross(u, v))), 0, {}, motion, shape);
  if (uv) append_flat_uv(e, place(shape.placement, q.corner) - origin, u, v);
}

void append_shape(const Box<>& b, const PlacedShape& shape, Vec3d origin, bool uv, bool motion, Elements& e) {
  for (std::int32_t i = 0; i < 6; ++i) {
    const BoxFace face = box_face_edges(b, i);
    append(e, to_float(turn(shape.placement, face.normal)), 0, {}, motion, shape);
    if (uv)
      append_flat_uv(e, place(shape.placement, face.corner) - origin, turn(shape.placement, face.u),
                     turn(shape.placement, face.v));
  }
}

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
  const Vec3d u = turn(placement, quad.u), v = turn(placement, quad.v);
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
  set_row(map, 0, (2 / size.x) * turn(placement, {1, 0, 0}), middle);
  set_row(map, 1, (2 / size.y) * turn(placement, {0, 1, 0}), middle);
  set_row(map, 2, (2 / size.z) * turn(placement, {0, 0, 1}), middle);
  return map;
}

void append_elements(const PlacedShape& shape, Vec3d origin, bool uv, bool motion, Elements& elements) {
  std::visit([&](const auto& s) { append_shape(s, shape, origin, uv, motion, elements); }, shape.shape);
}

}  // namespace tyndall
