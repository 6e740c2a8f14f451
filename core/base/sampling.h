#pragma once
#include "core/base/math.h"
#include "core/base/random.h"

/// Maps from the unit square to directions and discs, in closed form without rejection loops, so that each takes a
/// fixed number of dimensions; and choices among candidates.
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

/// Chooses one of several candidates that are offered one after the other, with probabilities in proportion to their
/// weights, by a single random number. (M. T. Chao, A General Purpose Unequal Probability Sampling Plan, Biometrika
/// 69(3), 1982)
template <class F>
struct Reservoir {
  F pick;              ///< random, in [0, 1): decides about the next thing
  F weight = F(0.0f);  ///< of all things so far

  /// Offers a candidate of weight `next` >= 0. Returns the lanes that take it in place of the one before.
  TYNDALL_INLINE MaskOf<F> offer(F next) {
    const F before = weight, at = pick * (before + next);
    const auto takes = less(at, next);
    const F left = select(takes, at, at - next) / max(select(takes, next, before), F(1e-37f));
    pick = select(less(F(0.0f), next), min(max(left, F(0.0f)), F(0.99999994f)), pick);
    weight = before + next;
    return takes;
  }
};

}  // namespace tyndall
