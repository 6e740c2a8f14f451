#pragma once
#include "core/base/math.h"
#include "core/base/random.h"

/// Maps from the unit square to directions and discs, in closed form without rejection loops, so that each takes a
/// fixed number of dimensions.
namespace tyndall {

/// Uniform on the unit sphere: z uniform in (-1, 1] (Archimedes), the angle around it uniform.
template <class F>
TYNDALL_INLINE Vec3<F> on_sphere(Pair<F> u) {
  const F z = mul_add(F(-2.0f), u.x, F(1.0f));
  const F r = sqrt(max(neg_mul_add(z, z, F(1.0f)), F(0.0f)));
  const SinCos<F> a = sin_cos_2pi(u.y);
  return {r * a.cos, r * a.sin, z};
}

/// Uniform in the unit disc: a fraction r² of the points is within radius r, the angle is uniform.
template <class F>
TYNDALL_INLINE Pair<F> in_disc(Pair<F> u) {
  const F r = sqrt(u.x);
  const SinCos<F> a = sin_cos_2pi(u.y);
  return {r * a.cos, r * a.sin};
}

/// A unit vector at an angle to the unit vector `axis`. cosine: of that angle, in [-1, 1]; u in [0, 1): azimuth in
/// revolutions.
template <class F>
TYNDALL_INLINE Vec3<F> around(Vec3<F> axis, F cosine, F u) {
  const Basis<F> b = basis_around(axis);
  const SinCos<F> a = sin_cos_2pi(u);
  const F sine = sqrt(max(neg_mul_add(cosine, cosine, F(1.0f)), F(0.0f)));
  return point_at(point_at(cosine * axis, sine * a.cos, b.s), sine * a.sin, b.t);
}

}  // namespace tyndall
