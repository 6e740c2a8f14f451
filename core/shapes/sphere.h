#pragma once
#include "core/base/fields.h"
#include "core/base/math.h"
#include "core/base/ray.h"

#include <optional>
#include <tuple>

/// Spheres: what users set, and where rays enter and leave one.
namespace tyndall {

/// A sphere. With center_end it moves: its centre is center + t (center_end - center) at time t. A negative radius
/// makes the normal point inward: with glass, a bubble.
template <class F = double>
struct Sphere {
  static constexpr const char* type = "sphere";
  static constexpr const char* about = "A sphere, at rest or moving.";
  Vec3<F> center;
  F radius = F(1);
  std::optional<Vec3<F>> center_end;
  bool operator==(const Sphere&) const = default;
};

template <class F>
constexpr auto fields(const Sphere<F>*) {
  return std::tuple{
      Field{"center", &Sphere<F>::center, any_number(), no_slider(), "", "centre, scene units", true}
          .called("Centre")
          .also("ball center, ball centre, object position"),
      Field{"center_end", &Sphere<F>::center_end, any_number(), no_slider(), "", "centre at time 1, scene units"}
          .called("Centre, end")
          .also("motion blur, movement"),
      Field{"radius", &Sphere<F>::radius, not_zero(), Slider{0.01, 10, true}, "",
            "scene units; negative: the normal points inward (hollow glass)", true}
          .also("diameter, ball size")};
}

/// Where a line crosses a sphere. to_center: centre - origin; direction: unit; radius > 0. The discriminant is computed
/// from the part of to_center across the ray, which keeps its digits if the sphere is far away or small. Haines,
/// Günther, Akenine-Möller, Precision Improvements for Ray/Sphere Intersection, Ray Tracing Gems (2019), chapter 7.
template <class F>
TYNDALL_INLINE Interval<F> sphere_interval(Vec3<F> to_center, F radius, Vec3<F> direction) {
  const F middle = dot(to_center, direction);
  const Vec3<F> across{neg_mul_add(middle, direction.x, to_center.x), neg_mul_add(middle, direction.y, to_center.y),
                       neg_mul_add(middle, direction.z, to_center.z)};
  const F discriminant = neg_mul_add(across.x, across.x,
                                     neg_mul_add(across.y, across.y, neg_mul_add(across.z, across.z, radius * radius)));
  const F half = sqrt(max(discriminant, F(0.0f)));
  return {middle - half, middle + half, less(F(0.0f), discriminant)};
}

/// Corrects the interval of a line for rays that start on or in the sphere. For a start on it the roots are exactly 0
/// and 2 d·(c - o), so that rounding of the origin cannot make the ray hit its own start or miss the far side.
template <class F>
TYNDALL_INLINE Interval<F> leave_sphere(Interval<F> line, Vec3<F> to_center, Vec3<F> direction, IntOf<F> from,
                                        Start<F> start) {
  const F middle = dot(to_center, direction);
  const F chord = select(equal(from & IntOf<F>(3), IntOf<F>(1)), middle + middle, line.far);
  return {select(start.here, F(-1.0f), line.near), select(start.here, max(chord, F(1e-37f)), line.far),
          mask_and_not(mask_or(line.hit, start.here), start.out)};
}

}  // namespace tyndall
