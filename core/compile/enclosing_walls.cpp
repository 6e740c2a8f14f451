#include "core/compile/enclosing_walls.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace tyndall {
namespace {

/// Extent of something along the normal of a plane: below (<= 0) and above (>= 0) the plane.
struct Reach {
  double low = 0, high = 0;
};

Reach reach_of(const Extent& extent, Vec3d normal, Vec3d on_plane) {
  Reach reach{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Vec3d& p : extent.points) {
    const double height = dot(normal, p - on_plane);
    reach = {std::min(reach.low, height - extent.radius), std::max(reach.high, height + extent.radius)};
  }
  return reach;
}

}  // namespace

bool bounds_scene(const Flattened& flat, std::size_t shape, const Camera& camera) {
  const auto* quad = std::get_if<Quad<>>(&flat.shapes[shape].shape);
  if (!quad) return false;
  const Placement& placement = flat.shapes[shape].placement;
  const Vec3d normal = normalize(rotate(placement, cross(quad->u, quad->v))), on_plane = place(placement, quad->corner);
  std::vector<Reach> others;
  for (std::size_t i = 0; i < flat.shapes.size(); ++i)
    if (i != shape) others.push_back(reach_of(extent_of(flat.shapes[i], camera), normal, on_plane));
  for (const PlacedVolume& volume : flat.volumes)
    others.push_back(reach_of(extent_of(volume, camera), normal, on_plane));
  Reach all;
  for (const Reach& other : others) all = {std::min(all.low, other.low), std::max(all.high, other.high)};
  const double rounding = 1e-7 * (all.high - all.low);
  const auto in_plane = [&](const Reach& r) { return r.high <= rounding && -r.low <= rounding; };
  return std::min(-all.low, all.high) <= rounding && std::none_of(others.begin(), others.end(), in_plane);
}

}  // namespace tyndall
