#pragma once
#include "core/specular/specular_slab.h"
#include "core/specular/sun_window.h"

/// Weighs lights found by BSDF sampling: a path that scatters into a sphere, mirror or slab and then hits a light
/// competes with the specular path that could have found the same light. For that, paths remember where they last
/// scattered and what they have met since (SpecularTrail).
namespace tyndall {

/// What a path remembers in scenes with specular paths, so that a light which it hits by BSDF sampling can be weighed
/// against them.
template <class F>
struct SpecularTrail {
  Vec3<F> start;  ///< where the path last scattered at a diffuse surface or in media
  F pdf;  ///< of its direction from there, per steradian, over the probability that it queried a specular path there
  SpecularHistory<F> met;  ///< events since then
};

/// The trail's history after a hit on `element`. reflected: lanes that leave on the side from which they came.
template <class F>
TYNDALL_INLINE SpecularHistory<F> meet_object(const SceneView& s, const SpecularTrail<F>& trail, const Ray<F>& ray,
                                              IntOf<F> element, MaskOf<F> reflected) {
  using I = IntOf<F>;
  const I code =
      lookup<F>(s.specular.sphere_of, s.element_count, element);  // 2 · object, + 1 for an inner sphere; or -1
  const auto none = mask_or(less(code, I(0)), less(trail.met.packed, I(0)));
  const I safe = select(none, I(0), code);
  const I object = as_int(shift_right<1>(as_uint(safe)));
  const Vec3<F> center = load_sphere<F>(s.specular, object, ray.time).center;
  const auto away = mask_and(trail.met.is_empty(), less(F(0.0f), dot(ray.direction, trail.start - center)));
  const SpecularHistory<F> before{select(none, I(0), trail.met.packed)};
  HistoryEvent<F> event = event_at_sphere<F>(before.packed, equal(safe & I(1), I(1)), reflected, away);
  if (s.specular.has_slabs()) {
    const auto by_slab = less_equal(I(s.specular.first_slab), object);
    const I first = lookup<F>(s.specular.outer, s.specular.spheres, object);
    const auto at = event_at_slab<F>(before.packed, as_int(shift_right<1>(as_uint(element - first))));
    event.start = select(by_slab, at.start, event.start), event.count = select(by_slab, at.count, event.count);
    event.is_full = mask_or(mask_and(by_slab, at.is_full), mask_and_not(event.is_full, by_slab));
  }
  return {select(none, I(-1), append_event(before, object, event).packed)};
}

/// Probability, in [0.03, 1], with which an event queries a specular path: the estimated light by specular paths over
/// the estimated light from lights directly, so that little time is spent where specular paths bring little. 1 where
/// there are more lights or pairs than max_lights_by_contribution.
template <class F>
[[gnu::noinline]] static F connect_probability(const SceneView& s, Vec3<F> point) {
  const LightView &pairs = s.specular.choice, &lights = s.lights;
  if (pairs.count > max_lights_by_contribution || lights.count > max_lights_by_contribution) return F(1.0f);
  F direct = total_worth(lights, point);
  if (s.samples_sky()) direct = direct + splat<F>(s.sky.irradiance);
  return min(max(total_worth(s.specular, point) / direct, F(0.03f)), F(1.0f));
}

/// Extends the trail by the surface of `element`, in the lanes `at_surface`. ray: by which the path came there.
/// reflected: lanes that leave on the side from which they came.
template <class F>
TYNDALL_INLINE void extend_trail(const SceneView& s, SpecularTrail<F>& trail, const Ray<F>& ray, MaskOf<F> at_surface,
                                 IntOf<F> element, MaskOf<F> reflected) {
  const auto goes_on = mask_and(at_surface, trail.met.goes_on());
  if (!any(goes_on)) return;
  trail.met.packed = select(goes_on, meet_object(s, trail, ray, element, reflected).packed, trail.met.packed);
}

/// Restarts the trail in lanes that have scattered at `point`, at a diffuse surface or in media. pdf: of their new
/// direction, per steradian. query: probability with which they queried a specular path.
template <class F>
TYNDALL_INLINE void restart_trail(SpecularTrail<F>& trail, MaskOf<F> lanes, Vec3<F> point, F pdf, F query) {
  trail.met.packed = select(lanes, IntOf<F>(0), trail.met.packed);
  trail.start = select(lanes, point, trail.start);
  trail.pdf = select(lanes, pdf / query, trail.pdf);
}

/// The events at a sphere or mirror, counted by kind.
template <class F>
TYNDALL_INLINE EventSequence<F> sequence_of(SpecularHistory<F> met) {
  return {from_int<F>(met.outer()), from_int<F>(met.inner()), from_int<F>(met.inner_reflected())};
}

/// The specular path that could have found a light which a path found by BSDF sampling.
template <class F>
struct BsdfHitPath {
  MaskOf<F> could;     ///< such a path exists
  F pdf;               ///< of its direction where it starts, per steradian, given its pair and its event sequence
  F expected_queries;  ///< see expected_queries()
  F throughput;        ///< fraction of light that the surfaces send along it
};

template <class F>
TYNDALL_INLINE BsdfHitPath<F> bsdf_hit_by_sphere(const SpecularView& c, const SpecularTrail<F>& trail,
                                                 const Ray<F>& ray, IntOf<F> sphere, const LightColumns<F>& light,
                                                 Vec3<F> point) {
  const SpecularSphere<F> b = load_sphere<F>(c, sphere, ray.time);
  const LightPoint<F> at = light_point_at(light, b, trail.start, ray.time, point);
  const PathPlane<F> plane = plane_of(b, trail.start, point);
  const PathEnds<F> ends = ends_of(b, plane.near, plane.far);
  EventSequence<F> sequence = sequence_of<F>(trail.met);
  const auto away = trail.met.began_away();
  sequence.near_sign = select(away, F(-1.0f), F(1.0f));
  const EndSigns<F> sign{select(mask_and_not(away, less(b.radius, plane.near)), F(-1.0f), F(1.0f)),
                         select(less(dot(ray.direction, plane.far_out), F(0.0f)), F(-1.0f), F(1.0f))};
  const SpecularDeflection<F> path = deflection_of(c, b, ends, sequence, sign);
  const F p = ends.far_reach * length(cross(plane.far_out, ray.direction));
  const F s2 = F(1.0f) - p / path.deflection.maximum, parameter = sqrt(max(s2, F(1e-12f)));
  const auto could = mask_and(
      path.possible, mask_and(less_equal(F(min_parameter), parameter), less_equal(parameter, path.deflection.last)));
  const F cosine = light_cosine(light, at.normal, ray.direction);
  const F spread =
      spread_of(path, ends, plane.sine, parameter, deflection_at(path.deflection, parameter).slope, cosine);
  return {mask_and(could, less(F(0.0f), cosine)), spread * at.pdf, expected_queries(b, ends, sequence),
          throughput_of(b, ends, sequence, p)};
}

template <class F>
TYNDALL_INLINE BsdfHitPath<F> bsdf_hit_by_mirror(const SpecularView& c, const SpecularTrail<F>& trail,
                                                 const Ray<F>& ray, IntOf<F> mirror, const LightColumns<F>& light,
                                                 Vec3<F> point) {
  const SpecularMirror<F> m = load_mirror<F>(c, mirror);
  const LightPoint<F> at = light_point_at(light, seen_by_mirror(m, trail.start), trail.start, ray.time, point);
  const MirrorPath<F> path = mirror_path(m, trail.start, point);
  const F cosine = light_cosine(light, at.normal, ray.direction);
  return {mask_and(path.found, less(F(0.0f), cosine)), path.spread / max(cosine, F(1e-30f)) * at.pdf, F(1.0f), F(1.0f)};
}

template <class F>
TYNDALL_INLINE BsdfHitPath<F> bsdf_hit_by_slab(const SpecularView& c, const SpecularTrail<F>& trail, const Ray<F>& ray,
                                               IntOf<F> slab, const LightColumns<F>& light, Vec3<F> point) {
  const SpecularSlab<F> p = load_slab<F>(c, slab);
  const SlabSequence<F> sequence = slab_sequence_of(p, trail.met, ray.direction);
  const BoundingSphere<F> around = bounding_sphere(light, ray.time);
  const SlabFrame<F> to_light = slab_frame(p, trail.start, around.center, sequence.across);
  const auto could = is_looked_for(p, to_light, around, sequence);
  const SpecularSphere<F> seen = seen_by_slab(p, to_light, sequence);
  const LightPoint<F> at = light_point_at(light, seen, seen.center, ray.time, point);
  const SlabFrame<F> s = slab_frame(p, trail.start, point, sequence.across);
  const F rises[3] = {dot(p.row[0], ray.direction), dot(p.row[1], ray.direction), dot(p.row[2], ray.direction)};
  const SlabPlace<F> rise = framed<F>(rises, sequence.across);
  const F slope =
      sqrt(mul_add(rise.side[0], rise.side[0], rise.side[1] * rise.side[1])) / max(abs(rise.height), F(1e-6f));
  SlabPath<F> path;
  follow_slope(s, sequence,
               reach_of(p.index, s.near_gap + s.far_gap, F(2.0f) * sequence.crossings * s.half.height, slope), path);
  const F cosine = light_cosine(light, at.normal, ray.direction);
  return {mask_and(could, less(F(0.0f), cosine)), path.spread / max(cosine, F(1e-30f)) * at.pdf, F(1.0f),
          path.throughput};
}

/// Copies `from` to `to` in the lanes `here`.
template <class F>
TYNDALL_INLINE void put(MaskOf<F> here, const BsdfHitPath<F>& from, BsdfHitPath<F>& to) {
  to.could = mask_or(mask_and(here, from.could), mask_and_not(to.could, here));
  to.pdf = select(here, from.pdf, to.pdf),
  to.expected_queries = select(here, from.expected_queries, to.expected_queries);
  to.throughput = select(here, from.throughput, to.throughput);
}

/// Weight, by the power heuristic, of a path that BSDF sampling found beside the specular path that could have.
template <class F>
TYNDALL_INLINE F weight_beside(const SpecularView& c, const SpecularTrail<F>& trail, const BsdfHitPath<F>& hit_path,
                               IntOf<F> pair, MaskOf<F> could) {
  const F probability = choice_probability(c, trail.start, pair);
  const F query_pdf = hit_path.pdf * probability * hit_path.expected_queries;
  const F inverse = query_pdf / max(trail.pdf * hit_path.throughput, F(1e-37f));
  const auto competes = mask_and(mask_and(could, hit_path.could), less(F(0.0f), query_pdf));
  return select(competes, F(1.0f) / mul_add(inverse, inverse, F(1.0f)), F(1.0f));
}

/// Weight, by the power heuristic, of the radiance of a light that the lanes `lit` hit by BSDF sampling at `point`,
/// after the events of their trail: r² / (1 + r²); 1 where no specular path could have found it. r: the pdf of the
/// path's direction where it last scattered times the probability that the surfaces sent it this way, over the pdf with
/// which a specular path would have been found.
template <class F>
[[gnu::noinline]] static F mis_weight_of_bsdf_hit(const SceneView& s, SpecularTrail<F> trail, Ray<F> ray,
                                                  IntOf<F> light, Vec3<F> point, MaskOf<F> lit) {
  using I = IntOf<F>;
  auto could = mask_and(mask_and(lit, less_equal(I(0), light)), trail.met.has_object());
  if (!any(could)) return F(1.0f);
  const SpecularView& c = s.specular;
  const I sphere = select(could, trail.met.object(), I(0));
  const I safe_light = select(could, light, I(0));
  const I pair = gather<F>(c.pair_of, sphere * I(s.lights.count) + safe_light);
  could = mask_and(could, less_equal(I(0), pair));
  if (!any(could)) return F(1.0f);
  const LightColumns<F> columns = load_light<F>(s.lights, safe_light);
  BsdfHitPath<F> hit_path{less(F(1.0f), F(0.0f)), F(0.0f), F(0.0f), F(0.0f)};
  if (c.has_spheres()) hit_path = bsdf_hit_by_sphere(c, trail, ray, sphere, columns, point);
  const I mirror = sphere - I(c.first_mirror), slab = sphere - I(c.first_slab);
  const auto is_slab = mask_and(could, less_equal(I(0), slab));
  const auto is_mirror = mask_and_not(mask_and(could, less_equal(I(0), mirror)), is_slab);
  if (c.has_mirrors() && any(is_mirror))
    put(is_mirror, bsdf_hit_by_mirror(c, trail, ray, select(is_mirror, mirror, I(0)), columns, point), hit_path);
  if (c.has_slabs() && any(is_slab))
    put(is_slab, bsdf_hit_by_slab(c, trail, ray, select(is_slab, slab, I(0)), columns, point), hit_path);
  return weight_beside(c, trail, hit_path, select(could, pair, I(0)), could);
}

/// mis_weight_of_bsdf_hit() of the sky, for rays that have left the scene in the lanes `escaped`.
template <class F>
[[gnu::noinline]] static F mis_weight_of_sun_hit(const SceneView& s, SpecularTrail<F> trail, Ray<F> ray,
                                                 MaskOf<F> escaped) {
  using I = IntOf<F>;
  const SpecularView& c = s.specular;
  auto could = mask_and(escaped, trail.met.has_object());
  if (!any(could)) return F(1.0f);
  const I sphere = select(could, trail.met.object(), I(0));
  const I pair = lookup<F>(c.sun_pair_of, c.spheres, sphere);
  could = mask_and(could, less_equal(I(0), pair));
  if (!any(could)) return F(1.0f);
  const LightColumns<F> window = sun_window(s.sky, load_sphere<F>(c, sphere, ray.time));
  const WindowHit<F> hit = pass_window(window, ray);
  could = mask_and(could, hit.hits);
  if (!any(could)) return F(1.0f);
  const BsdfHitPath<F> hit_path = bsdf_hit_by_sphere(c, trail, ray, sphere, window, hit.point);
  return weight_beside(c, trail, hit_path, select(could, pair, I(0)), could);
}

}  // namespace tyndall
