#pragma once
#include "core/base/fields.h"
#include "core/base/ray.h"

#include <tuple>

/// Parallelograms: what users set, and where rays hit one.
namespace tyndall {

/// A parallelogram: corner + a u + b v, a and b in [0, 1]. The normal is along u × v.
template <class F = double>
struct Quad {
  static constexpr const char* type = "quad";
  static constexpr const char* about = "A parallelogram: corner + a * u + b * v for a, b in [0, 1].";
  Vec3<F> corner, u{F(1), F(0), F(0)}, v{F(0), F(1), F(0)};
  bool operator==(const Quad&) const = default;
};

template <class F>
constexpr auto fields(const Quad<F>*) {
  return std::tuple{
      Field{"corner", &Quad<F>::corner, any_number(), no_slider(), "", "scene units", true}.also("quad position"),
      Field{"u", &Quad<F>::u, any_number(), no_slider(), "", "first edge, scene units", true}.called("Edge u").also(
          "quad width"),
      Field{"v", &Quad<F>::v, any_number(), no_slider(), "", "second edge, scene units", true}.called("Edge v").also(
          "quad height")};
}

/// Three affine functions of a point: each row gives row·p + offset. For a quad, rows 0 and 1 run from -1 to 1 across
/// it and row 2 is the distance from its plane; for a box all three run from -1 to 1.
template <class F>
struct AffineLanes {
  Vec3<F> row[3];
  F offset[3];
};
using Affine = AffineLanes<float>;  ///< the same ones for all lanes
inline constexpr int affine_numbers = 12;

template <class A, class F>
TYNDALL_INLINE F affine_point(const AffineLanes<A>& a, int row, Vec3<F> p) {
  const Vec3<A> r = a.row[row];
  return mul_add(F(r.x), p.x, mul_add(F(r.y), p.y, mul_add(F(r.z), p.z, F(a.offset[row]))));
}
template <class A, class F>
TYNDALL_INLINE F affine_direction(const AffineLanes<A>& a, int row, Vec3<F> d) {
  const Vec3<A> r = a.row[row];
  return mul_add(F(r.x), d.x, mul_add(F(r.y), d.y, F(r.z) * d.z));
}

template <class F>
struct QuadHit {
  F t;
  MaskOf<F> hit;
};

/// Distance along the ray to the quad; no hit beyond `limit`. A ray in the quad's plane misses (its distance is
/// infinite or not a number); edges belong to the quad. The Next Week, section 6 "Quadrilaterals", with the plane and
/// both edges as affine functions.
template <class F>
TYNDALL_INLINE QuadHit<F> hit_quad(const Affine& quad, Vec3<F> origin, Vec3<F> direction, F limit) {
  const F t = -affine_point(quad, 2, origin) / affine_direction(quad, 2, direction);
  MaskOf<F> hit = mask_and(less(F(0.0f), t), less_equal(t, limit));
  if (!any(hit)) return {t, hit};
  const Vec3<F> p = point_at(origin, t, direction);
  const F edge = max(abs(affine_point(quad, 0, p)), abs(affine_point(quad, 1, p)));
  return {t, mask_and(hit, less_equal(edge, F(1.0f)))};
}

}  // namespace tyndall
