#pragma once
#include "core/base/math.h"
#include "core/kernel/scene_view.h"

/// Flights in fog that end close to a lamp. Free flights, whose lengths follow the fog's density, seldom end there,
/// though a small lamp's light is strongest there, without bound: it falls with the squared distance. The few that do
/// would be bright dots in the picture. So distances are also sampled evenly in the angle at which a lamp sees them:
/// C. Kulla, M. Fajardo, Importance Sampling Techniques for Path Tracing in Participating Media, EGSR 2012, section 4.
/// This is done only for pairs of a medium and a lamp in it or near it.
namespace tyndall {

/// A distribution of distances along a ray, from begin to end: uniform in the angle seen from a lamp's centre.
template <class F>
struct Equiangular {
  F begin, end;
  F middle;  ///< distance to the place closest to the lamp's centre; may be outside of [begin, end]
  /// Distance from that place to the centre, increased by half of the lamp's reach (root of the sum of the squares),
  /// because that close to the lamp its light no longer grows with the inverse squared distance.
  F across;
  F angle;  ///< between begin and end, seen from the centre; 0: it is so narrow that distances are drawn uniformly
};

/// to_center: from the ray's origin to the lamp's centre. reach2: squared radius of a ball around it that holds the
/// lamp.
template <class F>
TYNDALL_INLINE Equiangular<F> equiangular(Vec3<F> to_center, F reach2, Vec3<F> direction, F begin, F end) {
  const F middle = dot(to_center, direction);
  const Vec3<F> way = along(to_center, -middle, direction);
  const F across = sqrt(max(mul_add(reach2, F(0.25f), dot(way, way)), F(1e-30f)));
  const F angle = atan2((end - begin) * across, mul_add(begin - middle, end - middle, across * across));
  return {begin, end, middle, across, select(less(angle, F(2e-3f)), F(0.0f), angle)};
}

/// Probability density per unit length.
template <class F>
TYNDALL_INLINE F density(const Equiangular<F>& e, F distance) {
  const F off = distance - e.middle;
  const auto uniform = equal(e.angle, F(0.0f));
  return select(uniform, F(1.0f), e.across) /
         select(uniform, e.end - e.begin, e.angle * mul_add(off, off, e.across * e.across));
}

/// The distance for a random number u in [0, 1).
template <class F>
TYNDALL_INLINE F sample(const Equiangular<F>& e, F u) {
  const SinCos<F> part = sin_cos_turn(u * e.angle * F(static_cast<float>(0.5 / pi)));
  const F first = e.begin - e.middle;
  const F off = e.across * mul_add(first, part.cos, e.across * part.sin) /
                neg_mul_add(first, part.sin, e.across * part.cos);  // across · tan of the angle
  const F distance = select(equal(e.angle, F(0.0f)), mul_add(u, e.end - e.begin, e.begin), e.middle + off);
  return min(max(distance, e.begin), e.end);
}

/// A flight along a ray that ended in a medium, with all that is needed to tell how likely each way of sampling was to
/// end it there.
template <class F>
struct FogFlight {
  IntOf<F> medium;  ///< -1: the flight did not end in one
  Vec3<F> origin, direction;
  F begin, end;  ///< distances at which its ray enters the medium, and leaves it or meets a surface
  F distance;    ///< where it ended
  F density;     ///< probability density, per unit length, with which free flights end there in this medium
};

/// The distribution by which a flight is ended by angle for a light.
template <class F>
TYNDALL_INLINE Equiangular<F> way_past(const LightView& l, IntOf<F> light, const FogFlight<F>& flight) {
  const auto at = [&](const float* column) { return lookup<F>(column, l.count, light); };
  const Vec3<F> center{at(l.center[0]), at(l.center[1]), at(l.center[2])};
  return equiangular(center - flight.origin, at(l.reach2), flight.direction, flight.begin, flight.end);
}

/// The term q² of the power heuristic in direct_light(). q is the density with which this flight is ended by angle for
/// `light`, over that with which it ends freely and `light` is then chosen with `probability`. 0 where flights in this
/// medium are never ended by angle for this light.
template <class F>
TYNDALL_INLINE F by_angle_odds(const SceneView& s, const FogFlight<F>& flight, IntOf<F> light, F probability) {
  const auto in_fog = less_equal(IntOf<F>(0), flight.medium);
  const IntOf<F> pair = select(in_fog, flight.medium * IntOf<F>(s.lights.count) + light, IntOf<F>(0));
  const F chosen = select(in_fog, gather<F>(s.near_probability, pair), F(0.0f));
  const auto could = less(F(0.0f), chosen);
  if (!any(could)) return F(0.0f);
  const F by_angle = chosen * density(way_past(s.lights, light, flight), flight.distance);
  const F odds = min(by_angle / max(flight.density * probability, F(1e-30f)), F(1e15f));
  return select(could, odds * odds, F(0.0f));
}

}  // namespace tyndall
