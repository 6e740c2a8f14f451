#include "core/compile/hull.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tyndall {
namespace {

/// What lies on which side of a plane.
struct Sides {
  Vec3d normal, point;
  double least = std::numeric_limits<double>::infinity(), most = -std::numeric_limits<double>::infinity();

  void add(Vec3d p, double radius = 0) {
    const double height = dot(normal, p - point);
    least = std::min(least, height - radius);
    most = std::max(most, height + radius);
  }
};

void add(Sides& sides, const Sphere<>& s, const Placement& placement, const Camera& camera) {
  const Vec3d way = s.center_end ? *s.center_end - s.center : Vec3d{};
  for (const double time : {camera.shutter_open, camera.shutter_close})
    sides.add(place(placement, s.center + time * way), std::abs(s.radius));
}

void add(Sides& sides, const Quad<>& q, const Placement& placement, const Camera&) {
  for (const Vec3d p : {q.corner, q.corner + q.u, q.corner + q.v, q.corner + q.u + q.v}) sides.add(place(placement, p));
}

void add(Sides& sides, const Box<>& b, const Placement& placement, const Camera&) {
  for (int i = 0; i < 8; ++i)
    sides.add(place(placement, {i & 1 ? b.max.x : b.min.x, i & 2 ? b.max.y : b.min.y, i & 4 ? b.max.z : b.min.z}));
}

}  // namespace

bool bounds_scene(const Flattened& flat, std::size_t shape, const Camera& camera) {
  const auto* quad = std::get_if<Quad<>>(&flat.shapes[shape].shape);
  if (!quad) return false;
  const Placement& placement = flat.shapes[shape].placement;
  Sides sides{normalize(turn(placement, cross(quad->u, quad->v))), place(placement, quad->corner)};
  for (const PlacedShape& other : flat.shapes)
    std::visit([&](const auto& s) { add(sides, s, other.placement, camera); }, other.shape);
  for (const PlacedVolume& volume : flat.volumes)
    std::visit([&](const auto& s) { add(sides, s, volume.placement, camera); }, volume.boundary);
  return std::min(-sides.least, sides.most) <= 1e-7 * (sides.most - sides.least);
}

}  // namespace tyndall
