#pragma once
#include "core/base/math.h"
#include "core/shapes/disk.h"
#include "core/shapes/quad.h"
#include "core/shapes/triangle.h"

/// Flat shapes that fill a part of a parallelogram, their frame: where rays hit them, and how points on them are drawn.
namespace tyndall {

/// What a flat shape fills of its frame, in the frame's coordinates x and y, which run from -1 to 1 (see Affine).
struct Outline {
  enum Kind : std::int32_t { triangle, ring };  ///< triangle: x + y <= 0; ring: inner² <= x² + y² <= 1
  Kind kind = triangle;
  /// Of a ring: radius of the hole, in [0, 1); 0: a disk. Of a triangle that rays are traced against: twice the
  /// distance of its farthest corner from the origin, see hit_outlined().
  float size = 0;
};

/// The parallelogram that a triangle is half of.
inline Quad<> frame_of(const Triangle<>& t) { return {t.corner, t.u, t.v}; }
inline Outline outline_of(const Triangle<>&) { return {Outline::triangle}; }

/// The parallelogram around a disk, whose sides its rim touches in the middle.
inline Quad<> frame_of(const Disk<>& d) { return {d.center - d.u - d.v, 2.0 * d.u, 2.0 * d.v}; }
inline Outline outline_of(const Disk<>& d) { return {Outline::ring, static_cast<float>(d.inner)}; }

template <class T>
inline constexpr bool has_outline = requires(const T& shape) {
  outline_of(shape);
};

/// Fraction of the frame's area within the outline, in (0, 1).
inline double area_fraction(const Outline& o) {
  const double inner = static_cast<double>(o.size);
  return o.kind == Outline::triangle ? 0.5 : 0.25 * pi * (1 - inner * inner);
}

/// Whether the point (x, y) of the frame is within the outline. Edges belong to it.
template <class F>
TYNDALL_INLINE MaskOf<F> within(const Outline& o, F x, F y) {
  if (o.kind == Outline::triangle) return mask_and(less_equal(max(-x, -y), F(1.0f)), less_equal(x + y, F(0.0f)));
  const F r2 = mul_add(x, x, y * y);
  return mask_and(less_equal(r2, F(1.0f)), less_equal(splat<F>(o.size * o.size), r2));
}

/// hit_quad() for a shape within an outline. map: of its frame; of a triangle see triangle_map(). A triangle is as much
/// wider as rounding may have moved the point, which is more for rays that meet it at a slant, so that none slips
/// between two that share corners.
template <class F>
TYNDALL_INLINE QuadHit<F> hit_outlined(const Affine& map, const Outline& outline, Vec3<F> origin, Vec3<F> direction,
                                       F limit) {
  const F slope = affine_direction(map, 2, direction), t = -affine_point(map, 2, origin) / slope;
  MaskOf<F> hit = mask_and(less(F(0.0f), t), less_equal(t, limit));
  if (!any(hit)) return {t, hit};
  const Vec3<F> p = point_at(origin, t, direction);
  const F x = affine_point(map, 0, p), y = affine_point(map, 1, p);
  if (outline.kind != Outline::triangle) return {t, mask_and(hit, within(outline, x, y))};
  const F beyond = max(F(-1.0f) - min(x, y), x + y) * abs(slope);
  const F from = abs(origin.x) + abs(origin.y) + abs(origin.z);
  return {t, mask_and(hit, less_equal(beyond, from + splat<F>(outline.size)))};
}

/// A point drawn uniformly from a triangle by u in [0, 1)²: fractions of the frame's edges. The half of the frame
/// beyond the triangle is turned about the middle of the frame onto it.
template <class F>
TYNDALL_INLINE Pair<F> in_triangle(Pair<F> u) {
  const auto beyond = less(F(1.0f), u.x + u.y);
  return {select(beyond, F(1.0f) - u.x, u.x), select(beyond, F(1.0f) - u.y, u.y)};
}

/// The same for a ring. The area within a radius is proportional to its square, and all angles are equally likely: an
/// affine map of a disk onto an ellipse leaves both so.
template <class F>
TYNDALL_INLINE Pair<F> in_ring(F inner, Pair<F> u) {
  const F inner2 = inner * inner, half_radius = F(0.5f) * sqrt(mul_add(u.x, F(1.0f) - inner2, inner2));
  const SinCos<F> a = sin_cos_2pi(u.y);
  return {mul_add(half_radius, a.cos, F(0.5f)), mul_add(half_radius, a.sin, F(0.5f))};
}

/// uv of the point of a disk at the fractions a and b of its frame's edges: its distance from the centre, 1 at the rim,
/// and its angle from the first half axis towards the second, in revolutions.
template <class F>
TYNDALL_INLINE Pair<F> disk_uv(F a, F b) {
  const F x = mul_add(F(2.0f), a, F(-1.0f)), y = mul_add(F(2.0f), b, F(-1.0f));
  const F revolutions = atan2(y, x) * F(static_cast<float>(0.5 / pi));
  return {sqrt(mul_add(x, x, y * y)), select(less(revolutions, F(0.0f)), revolutions + F(1.0f), revolutions)};
}

}  // namespace tyndall
