#pragma once
#include "core/base/math.h"
#include "core/base/ray.h"
#include "core/media/medium.h"
#include "core/shapes/box.h"
#include "core/shapes/sphere.h"
#include "core/trace/scene_view.h"

/// Flights through media: where along its ray a path scatters before it meets a surface.
namespace tyndall {

/// Where a path scatters in a medium. The other members are set only in lanes in which `happens`, except for medium and
/// texture, which are -1 in other lanes.
template <class F>
struct MediumEvent {
  MaskOf<F> happens;
  IntOf<F> medium, texture;
  Vec3<F> point;
  IntOf<F> from;  ///< Ray::from of rays that start in the medium
  Vec3<F> albedo;
  F g;        ///< asymmetry of the phase function; 0 in scenes without phase functions
  F density;  ///< of the medium: events per unit length; only in scenes with lights in media
  F begin,
      far;  ///< where the ray enters and leaves the medium; only in scenes with lights in media
};

/// No event in any lane. Clearing all members in every step would take up to an eighth of the time in media.
template <class F>
TYNDALL_INLINE MediumEvent<F> no_event() {
  MediumEvent<F> event;
  event.happens = less(F(1.0f), F(0.0f));
  event.medium = event.texture = IntOf<F>(-1);
  event.g = F(0.0f);
  return event;
}

/// The distances between which a line is inside a medium's boundary. from: see Ray.
template <class F>
TYNDALL_INLINE Interval<F> medium_interval(const MediumColumns& m, Vec3<F> origin, Vec3<F> direction, IntOf<F> from) {
  const Start<F> start = start_on<F>(from, m.first, m.count);
  if (m.box) {
    const BoxSlabs<F> slabs = box_slabs(m.map, origin, direction);
    if (!any(start.here)) return slabs.inside;
    const Interval<F> line = leave_box(slabs.inside, start);
    const auto within =
        mask_and(start.here, equal(from & IntOf<F>(3), IntOf<F>(static_cast<std::int32_t>(Side::within))));
    return {line.near, select(within, leave_from_within(slabs), line.far), line.hit};
  }
  const Vec3<F> to_center = splat<F>(m.center) - origin;
  const Interval<F> line = sphere_interval(to_center, splat<F>(m.radius), direction);
  return any(start.here) ? leave_sphere(line, to_center, direction, from, start) : line;
}

/// The point at which a ray enters a medium; its origin if it starts inside. After a long distance the point is rounded
/// to the spacing of floats. Where that could exceed a thousandth of a mean free path, the point is computed a second
/// time, starting from the first result.
template <class F>
TYNDALL_INLINE Vec3<F> enter_medium(const MediumColumns& m, const Ray<F>& ray, const Interval<F>& inside,
                                    MaskOf<F> lanes) {
  const F begin = max(inside.near, F(0.0f));
  const Vec3<F> point = point_at(ray.origin, select(lanes, begin, F(0.0f)), ray.direction);
  const auto dense = mask_and(lanes, less(F(0x1p14f), splat<F>(m.density) * inside.far));
  if (!any(dense)) return point;
  const Start<F> start = start_on<F>(ray.from, m.first, m.count);
  const auto on_surface = mask_and(start.here, equal(ray.from & IntOf<F>(3), IntOf<F>(1)));
  const auto inexact = mask_and(dense, mask_or(on_surface, less(F(0.0f), begin)));
  if (!any(inexact)) return point;
  const Interval<F> again = medium_interval(m, point, ray.direction, IntOf<F>(from_nowhere));
  return point_at(point, select(mask_and(inexact, again.hit), again.near, F(0.0f)), ray.direction);
}

/// Draws where a path scatters in media before it hits a surface. Each medium has a free flight of its own, and the
/// shortest counts; this is right for overlapping media, too, because their densities add. Media that weigh paths are
/// left to transmitted_by_absorbers(). nearest: distance to the surface; shortened to the event where there is one.
/// event: what no_event() returns, on entry.
template <class F>
TYNDALL_INLINE void fly_through_media(const auto& s, const Ray<F>& ray, const Sampler<F>& sampler, MaskOf<F> active,
                                      F& nearest, MediumEvent<F>& event) {
  const F infinity = F(__builtin_inff());
  for (int k = 0; k < s.media.count(); ++k) {
    const MediumColumns& m = s.media[k];
    if (m.weighs) continue;
    const Interval<F> inside = medium_interval(m, ray.origin, ray.direction, ray.from);
    const F begin = max(inside.near, F(0.0f)), end = min(inside.far, nearest);
    const auto crosses = mask_and(mask_and(inside.hit, active), less(begin, end));
    if (!any(crosses)) continue;
    const F flight =
        free_flight(splat<F>(m.density), sampler.open(dimension::free_flight, static_cast<std::uint32_t>(k)));
    const F t = begin + flight;
    const auto here = mask_and(mask_and(crosses, less(t, end)), less(t, infinity));
    nearest = select(here, t, nearest);
    event.happens = mask_or(event.happens, here);
    const Vec3<F> entry = enter_medium(m, ray, inside, here);
    event.point = select(here, point_at(entry, flight, ray.direction), event.point);
    event.medium = select(here, IntOf<F>(k), event.medium);
    if (s.has_lights_in_media()) {
      event.density = select(here, splat<F>(m.density), event.density);
      event.begin = select(here, begin, event.begin), event.far = select(here, inside.far, event.far);
    }
    event.from = select(here, IntOf<F>(4 * m.first + static_cast<std::int32_t>(Side::within)), event.from);
    event.albedo = select(here, splat<F>(m.albedo), event.albedo);
    if (s.has_textures()) event.texture = select(here, IntOf<F>(m.texture), event.texture);
    if (s.features.phase_functions) event.g = select(here, splat<F>(m.g), event.g);
  }
}

/// Transmittance, in [0, 1], of all media up to `distance`.
template <class F>
TYNDALL_INLINE F pass_media(const SceneView& s, const Ray<F>& ray, F distance, MaskOf<F> active) {
  F depth = F(0.0f);
  for (int k = 0; k < s.media.count(); ++k) {
    const Interval<F> inside = medium_interval(s.media[k], ray.origin, ray.direction, ray.from);
    const F begin = max(inside.near, F(0.0f)), end = min(inside.far, distance);
    const auto crosses = mask_and(mask_and(inside.hit, active), less(begin, end));
    if (any(crosses)) depth = select(crosses, mul_add(end - begin, splat<F>(s.media[k].density), depth), depth);
  }
  return any(less(F(0.0f), depth)) ? transmittance(depth) : F(1.0f);
}

/// Russian roulette only ends paths whose throughput is below this. All values from 1/8 to 1/4 were measured to take
/// the same time to a given error.
inline constexpr float min_carried = 0.125f;

/// Factor on a path's throughput for media that only absorb, up to `distance`. If such a medium ended paths at random,
/// few would reach what is behind it, each with a large weight. So the path is multiplied by each medium's
/// transmittance. Below `min_carried`, Russian roulette leaves the path that much or nothing.
template <class F>
TYNDALL_INLINE F transmitted_by_absorbers(const SceneView& s, const Ray<F>& ray, const Sampler<F>& sampler, F distance,
                                          MaskOf<F> active) {
  F kept = F(1.0f);
  for (int k = 0; k < s.media.count(); ++k) {
    const MediumColumns& m = s.media[k];
    if (!m.weighs) continue;
    const Interval<F> inside = medium_interval(m, ray.origin, ray.direction, ray.from);
    const F begin = max(inside.near, F(0.0f)), end = min(inside.far, distance);
    const auto crosses = mask_and(mask_and(inside.hit, active), less(begin, end));
    if (!any(crosses)) continue;
    const F passes = transmittance(splat<F>(m.density) * (end - begin));
    const F u = sampler.open(dimension::free_flight, static_cast<std::uint32_t>(k));
    const auto goes_on = less_equal(F(min_carried) * u, passes);
    kept = select(crosses, kept * select(goes_on, max(passes, F(min_carried)), F(0.0f)), kept);
  }
  return kept;
}

/// Pdf, per steradian, of scattering in a medium from direction `before` into `after`. g: asymmetry of the phase
/// function.
template <class F>
TYNDALL_INLINE F phase_pdf(const auto& s, F g, Vec3<F> before, Vec3<F> after) {
  if (!s.features.phase_functions) return F(static_cast<float>(0.25 / pi));  // the formula for g = 0
  return henyey_greenstein_pdf(g, dot(before, after));
}

// Flights in media that end close to a light. Near a small light its radiance grows without bound, with the inverse
// squared distance, but free flights, whose lengths follow the medium's density, seldom end there. The few that do
// would be bright dots in the picture. So distances are also sampled uniformly in the angle at which a light sees them:
// C. Kulla, M. Fajardo, Importance Sampling Techniques for Path Tracing in Participating Media, EGSR 2012, section 4.
// This is done only for pairs of a medium and a light in it or near it.

/// A distribution of distances along a ray, from begin to end: uniform in the angle seen from a light's centre.
template <class F>
struct Equiangular {
  F begin, end;
  F middle;  ///< distance to the point closest to the light's centre; may be outside of [begin, end]
  /// Distance from that point to the centre, increased by half of the light's reach (root of the sum of the squares),
  /// because this close to the light its radiance no longer grows with the inverse squared distance.
  F across;
  F angle;  ///< between begin and end, seen from the centre; 0: so small that distances are drawn uniformly
};

/// to_center: from the ray's origin to the light's centre. reach2: squared radius of a sphere around the centre that
/// encloses the light.
template <class F>
TYNDALL_INLINE Equiangular<F> equiangular(Vec3<F> to_center, F reach2, Vec3<F> direction, F begin, F end) {
  const F middle = dot(to_center, direction);
  const Vec3<F> offset = point_at(to_center, -middle, direction);
  const F across = sqrt(max(mul_add(reach2, F(0.25f), dot(offset, offset)), F(1e-30f)));
  const F angle = atan2((end - begin) * across, mul_add(begin - middle, end - middle, across * across));
  return {begin, end, middle, across, select(less(angle, F(2e-3f)), F(0.0f), angle)};
}

/// Pdf per unit length.
template <class F>
TYNDALL_INLINE F pdf(const Equiangular<F>& e, F distance) {
  const F off = distance - e.middle;
  const auto uniform = equal(e.angle, F(0.0f));
  return select(uniform, F(1.0f), e.across) /
         select(uniform, e.end - e.begin, e.angle * mul_add(off, off, e.across * e.across));
}

/// Draws the distance from a random number u in [0, 1).
template <class F>
TYNDALL_INLINE F sample(const Equiangular<F>& e, F u) {
  const SinCos<F> part = sin_cos_2pi(u * e.angle * F(static_cast<float>(0.5 / pi)));
  const F first = e.begin - e.middle;
  const F off = e.across * mul_add(first, part.cos, e.across * part.sin) /
                neg_mul_add(first, part.sin, e.across * part.cos);  // across · tan of the angle
  const F distance = select(equal(e.angle, F(0.0f)), mul_add(u, e.end - e.begin, e.begin), e.middle + off);
  return min(max(distance, e.begin), e.end);
}

/// A flight along a ray that ended in a medium, with what is needed to compute the pdf of each sampling strategy for
/// it.
template <class F>
struct MediumFlight {
  IntOf<F> medium;  ///< -1: the flight did not end in a medium
  Vec3<F> origin, direction;
  F begin, end;  ///< distances at which the ray enters the medium, and leaves it or hits a surface
  F distance;    ///< where it ended
  F pdf;         ///< pdf, per unit length, with which free flights end there in this medium
};

/// The distribution of distances for a flight that is ended by angle for a light.
template <class F>
TYNDALL_INLINE Equiangular<F> distances_past(const Lights& l, IntOf<F> light, const MediumFlight<F>& flight) {
  const Vec3<F> to_center = lookup<F>(l.center, l.count(), light) - flight.origin;
  return equiangular(to_center, lookup<F>(l.reach2, l.count(), light), flight.direction, flight.begin, flight.end);
}

/// The term q² of the power heuristic in direct_light(). q: the pdf with which this flight is ended by angle for
/// `light`, over the pdf with which it ends freely and `light` is then chosen with `probability`. 0 where flights in
/// this medium are never ended by angle for this light.
template <class F>
TYNDALL_INLINE F by_angle_odds(const SceneView& s, const MediumFlight<F>& flight, IntOf<F> light, F probability) {
  const auto in_medium = less_equal(IntOf<F>(0), flight.medium);
  const IntOf<F> pair = select(in_medium, flight.medium * IntOf<F>(s.lights.count()) + light, IntOf<F>(0));
  const F chosen = select(in_medium, gather<F>(s.near.probability, pair), F(0.0f));
  const auto could = less(F(0.0f), chosen);
  if (!any(could)) return F(0.0f);
  const F by_angle = chosen * pdf(distances_past(s.lights, light, flight), flight.distance);
  const F odds = min(by_angle / max(flight.pdf * probability, F(1e-30f)), F(1e15f));
  return select(could, odds * odds, F(0.0f));
}

}  // namespace tyndall
