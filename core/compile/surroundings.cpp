#include "core/compile/surroundings.h"

#include "core/compile/columns.h"
#include "core/shapes/outline.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tyndall {
namespace {

// Relative to the largest number involved. Single precision rounds to 2^-24, and tests of spheres square and subtract.
constexpr double rounding_fraction = 0x1p-21, touching_sphere = 0x1p-24, touching_flat = 0x1p-40;
constexpr double lens_rounding = 0x1p-22;  // of heights of points of the lens, over its radius

double largest_component(Vec3d v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

/// Compares the camera with one surface after the other, and keeps the nearest.
class NearestSurface {
 public:
  NearestSurface(const Camera& camera, Vec3d origin)
      : camera_(camera), eye_(camera.look_from), origin_(origin), lens_(lens_radius(camera)) {}

  CameraSurface found;

  void look_at(const Sphere<>& sphere, const Placement& placement, std::int32_t element) {
    Vec3d center = sphere.center;
    if (sphere.center_end && *sphere.center_end != sphere.center) {
      if (camera_.shutter_open != camera_.shutter_close) return;
      center = center + camera_.shutter_open * (*sphere.center_end - sphere.center);
    }
    center = place(placement, center);
    const Vec3d arm = eye_ - center;
    const double distance = length(arm), radius = std::abs(sphere.radius);
    if (distance == 0) return;
    const double size = std::max(largest_component(center - origin_), radius);
    keep((1 / distance) * arm, distance - radius, 1 / radius, size, element);
  }
  /// outline: of the shape of which the face is the frame; nothing: there is none.
  void look_at(const BoxFace& face, const std::optional<Outline>& outline, std::int32_t element) {
    const Vec3d arm = eye_ - face.corner;
    const Reciprocal r = reciprocal_edges(face.u, face.v);
    const double room_a = lens_ * length(r.a), room_b = lens_ * length(r.b), a = dot(r.a, arm), b = dot(r.b, arm);
    if (a < room_a || a > 1 - room_a || b < room_b || b > 1 - room_b) return;
    // The middle and the corners of a rectangle around the lens have to lie within the outline.
    const double x = 2 * a - 1, y = 2 * b - 1;
    if (outline && !within(*outline, x, y)) return;
    for (const double i : {-2 * room_a, 2 * room_a})
      for (const double k : {-2 * room_b, 2 * room_b})
        if (outline && !within(*outline, x + i, y + k)) return;
    const Vec3d normal = normalize(cross(face.u, face.v)), from = face.corner - origin_;
    const double size = std::max(largest_component(from), largest_component(from + face.u + face.v));
    keep(normal, dot(normal, arm), 0, size, element);
  }

 private:
  const Camera& camera_;
  Vec3d eye_, origin_;
  double lens_;

  /// size: the largest number that is rounded in tests of rays against the surface. curvature: 0 for flats.
  void keep(Vec3d normal, double height, double curvature, double size, std::int32_t element) {
    const double largest = std::max(size, largest_component(eye_ - origin_)), rounding = rounding_fraction * largest;
    const double slack = (curvature == 0 ? touching_flat : touching_sphere) * largest + lens_rounding * lens_;
    if (std::abs(height) > rounding) return;
    if (found.element >= 0 && std::abs(static_cast<double>(found.height)) <= std::abs(height)) return;
    found = {element,
             to_float(normal),
             static_cast<float>(height),
             static_cast<float>(curvature),
             static_cast<float>(rounding),
             static_cast<float>(slack)};
  }
};

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

CameraSurface camera_surface(const Flattened& flat, const std::vector<std::int32_t>& first_element,
                             const Camera& camera, Vec3d origin) {
  NearestSurface nearest(camera, origin);
  for (std::size_t i = 0; i < flat.shapes.size(); ++i) {
    const PlacedShape& placed = flat.shapes[i];
    if (const auto* sphere = std::get_if<Sphere<>>(&placed.shape))
      nearest.look_at(*sphere, placed.placement, first_element[i]);
    std::optional<Outline> outline;
    std::visit(
        [&]<class Shape>(const Shape& shape) {
          if constexpr (has_outline<Shape>) outline = outline_of(shape);
        },
        placed.shape);
    each_face(placed,
              [&](const BoxFace& face, std::int32_t k) { nearest.look_at(face, outline, first_element[i] + k); });
  }
  return nearest.found;
}

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
