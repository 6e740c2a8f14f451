#pragma once
#include "core/specular/specular_slab.h"
#include "core/specular/sun_window.h"

/// Weighs lights found by BSDF sampling: a path that scatters into a sphere, mirror or slab and then hits a light
/// competes with the specular path that could have found the same light. For that, paths remember where they last
/// scattered and what they have met since (SpecularTrail).
namespace tyndall {

/// Counts of the events at one specular object, packed into one integer, because a path carries it through each step:
///
///   0                 nothing was met yet
///   -1                something was met that no specular path meets, or more events of one kind than can be counted
///   otherwise         the object's index + 1 in bits 14 and up, and below them three counts and where the path began
///                         at a sphere, a shell or a flat mirror            at a slab
///       bits 0-3      events at the outer sphere                           events at the two faces across edge 0
///       bits 4-7      events at the inner sphere                           across edge 1
///       bits 8-11     reflections at the inner sphere                      across edge 2
///       bits 12-13    1: the path first moved away from the centre; or 0   the edge across which it met the first face
template <class F>
struct SpecularHistory {
  using I = IntOf<F>;

  I packed;

  TYNDALL_INLINE MaskOf<F> is_empty() const { return equal(packed, I(0)); }
  /// False after something that no specular path meets.
  TYNDALL_INLINE MaskOf<F> goes_on() const { return less_equal(I(0), packed); }
  TYNDALL_INLINE MaskOf<F> has_object() const { return less(I(0), packed); }
  /// The object's index where has_object(), else any number.
  TYNDALL_INLINE I object() const { return as_int(shift_right<14>(as_uint(packed))) - I(1); }
  template <int k>
  TYNDALL_INLINE F count() const {
    return from_int<F>(as_int(shift_right<4 * k>(as_uint(packed))) & I(15));
  }
  TYNDALL_INLINE I start() const { return as_int(shift_right<12>(as_uint(packed))) & I(3); }

  /// The history after an event at `object`. first: start() if nothing was met before. added: 1 in the bits of the
  /// counts that it increases. limit: the bits of the count that must not be full.
  TYNDALL_INLINE SpecularHistory after(I object, I first, I added, I limit) const {
    const I name = as_int(shift_left<14>(as_uint(object + I(1))));
    const I before = select(is_empty(), name + as_int(shift_left<12>(as_uint(first))), packed);
    const auto same = equal(before & I(~0x3fff), name);
    return {select(mask_and_not(same, equal(before & limit, limit)), before + added, I(-1))};
  }
};

/// What a path remembers in scenes with specular paths, so that a light which it hits by BSDF sampling can be weighed
/// against them.
template <class F>
struct SpecularTrail {
  Vec3<F> start;  ///< where the path last scattered at a diffuse surface or in media
  F pdf;  ///< of its direction from there, per steradian, over the probability that it queried a specular path there
  SpecularHistory<F> met;  ///< events since then
};

/// Probability, in [0.03, 1], with which an event queries a specular path: the estimated light by specular paths over
/// the estimated light from lights directly, so that little time is spent where specular paths bring little. 1 where
/// there are more lights or pairs than max_lights_by_contribution.
template <class F>
[[gnu::noinline]] static F connect_probability(const SceneView& s, Vec3<F> point) {
  const Lights &pairs = s.specular.choice, &lights = s.lights;
  if (pairs.count() > max_lights_by_contribution || lights.count() > max_lights_by_contribution) return F(1.0f);
  F direct = total_worth(lights, point);
  if (s.samples_sky()) direct = direct + splat<F>(s.sky.irradiance);
  return min(max(total_worth(s.specular, point) / direct, F(0.03f)), F(1.0f));
}

/// Extends the trail by the surface of `element`, in the lanes `at_surface`. ray: by which the path came there.
/// reflected: lanes that leave on the side from which they came.
template <class F>
TYNDALL_INLINE void extend_trail(const SceneView& s, SpecularTrail<F>& trail, const Ray<F>& ray, MaskOf<F> at_surface,
                                 IntOf<F> element, MaskOf<F> reflected) {
  using I = IntOf<F>;
  const auto goes_on = mask_and(at_surface, trail.met.goes_on());
  if (!any(goes_on)) return;
  const I code =
      lookup<F>(s.specular.sphere_of, s.elements.count(), element);  // 2 · object, + 1 for an inner sphere; or -1
  const auto known = mask_and(goes_on, less_equal(I(0), code));
  const I safe = select(known, code, I(0)), object = as_int(shift_right<1>(as_uint(safe)));
  const Vec3<F> center = load_sphere<F>(s.specular, object, ray.time).center;
  const auto inner = equal(safe & I(1), I(1)), away = less(F(0.0f), dot(ray.direction, trail.start - center));
  I first = select(away, I(1), I(0)), limit = select(inner, I(0xf0), I(0xf));
  I added = select(inner, select(reflected, I(0x110), I(0x10)), I(1));
  if (s.specular.has_slabs()) {
    const auto by_slab = less_equal(I(s.specular.first_slab), object);
    const I face = element - lookup<F>(s.specular.outer, s.specular.spheres(), object);
    const I edge = as_int(shift_right<1>(as_uint(face)));
    const I one = select(equal(edge, I(0)), I(1), select(equal(edge, I(1)), I(0x10), I(0x100)));
    first = select(by_slab, edge, first), added = select(by_slab, one, added);
    limit = select(by_slab, one * I(0xf), limit);
  }
  const I met = trail.met.after(object, first, added, limit).packed;
  trail.met.packed = select(known, met, select(goes_on, I(-1), trail.met.packed));
}

/// Restarts the trail in lanes that have scattered at `point`, at a diffuse surface or in media. pdf: of their new
/// direction, per steradian. query: probability with which they queried a specular path.
template <class F>
TYNDALL_INLINE void restart_trail(SpecularTrail<F>& trail, MaskOf<F> lanes, Vec3<F> point, F pdf, F query) {
  trail.met.packed = select(lanes, IntOf<F>(0), trail.met.packed);
  trail.start = select(lanes, point, trail.start);
  trail.pdf = select(lanes, pdf / query, trail.pdf);
}

/// The event sequence of a path that met a slab by BSDF sampling. direction: in which the path left the slab.
template <class F>
TYNDALL_INLINE SlabSequence<F> slab_sequence_of(const SpecularFlat<F>& slab, SpecularHistory<F> met,
                                                Vec3<F> direction) {
  const F count[3] = {met.template count<0>(), met.template count<1>(), met.template count<2>()};
  const F rises[3] = {dot(slab.row[0], direction), dot(slab.row[1], direction), dot(slab.row[2], direction)};
  SlabSequence<F> sequence;
  sequence.across = met.start();
  const SlabPlace<F> counts = framed<F>(count, sequence.across), heading = framed<F>(rises, sequence.across);
  sequence.crossings = counts.height - F(1.0f);
  for (int k = 0; k < 2; ++k)
    sequence.image[k] = copy_sign(counts.side[k], parity_sign(counts.side[k]) * heading.side[k]);
  return sequence;
}

/// The specular path that could have found a light which a path found by BSDF sampling.
template <class F>
struct BsdfHitPath {
  F pdf;  ///< of its direction where it starts, per steradian, given its pair and its event sequence; 0: none exists
  F queries;     ///< see expected_queries()
  F throughput;  ///< fraction of light that the surfaces send along it
};

/// The BsdfHitPath of a path off a flat mirror or through a slab to a point of a light.
template <class F>
TYNDALL_INLINE BsdfHitPath<F> bsdf_hit_by_flats(const LightColumns<F>& light, const LightPoint<F>& at,
                                                Vec3<F> direction, MaskOf<F> could, F spread, F throughput) {
  const F cosine = light_cosine(light, at.normal, direction);
  const F pdf = spread / max(cosine, F(1e-30f)) * at.pdf;
  return {select(mask_and(could, less(F(0.0f), cosine)), pdf, F(0.0f)), F(1.0f), throughput};
}

template <class F>
TYNDALL_INLINE BsdfHitPath<F> bsdf_hit_by_sphere(const SpecularPairs& c, const SpecularTrail<F>& trail,
                                                 const Ray<F>& ray, IntOf<F> sphere, const LightColumns<F>& light,
                                                 Vec3<F> point) {
  const SpecularSphere<F> b = load_sphere<F>(c, sphere, ray.time);
  const LightPoint<F> at = light_point_at(light, {b.center, b.radius}, trail.start, ray.time, point);
  const PathPlane<F> plane = plane_of(b, trail.start, point);
  const PathEnds<F> ends = ends_of(b, plane.near, plane.far);
  const auto away = equal(trail.met.start(), IntOf<F>(1));
  const EventSequence<F> sequence{trail.met.template count<0>(), trail.met.template count<1>(),
                                  trail.met.template count<2>(), select(away, F(-1.0f), F(1.0f))};
  const EndSigns<F> sign{select(mask_and_not(away, less(b.radius, plane.near)), F(-1.0f), F(1.0f)),
                         select(less(dot(ray.direction, plane.far_out), F(0.0f)), F(-1.0f), F(1.0f))};
  const Deflection<F> path = deflection_of(c, b, ends, sequence, sign);
  const F p = ends.far_reach * length(cross(plane.far_out, ray.direction));
  const F s2 = F(1.0f) - p / path.maximum, parameter = sqrt(max(s2, F(1e-12f)));
  const auto could =
      mask_and(path.possible, mask_and(less_equal(F(min_parameter), parameter), less_equal(parameter, path.last)));
  const F cosine = light_cosine(light, at.normal, ray.direction);
  const F spread = spread_of(path, ends, plane.sine, parameter, deflection_at(path, parameter).slope, cosine);
  return {select(mask_and(could, less(F(0.0f), cosine)), spread * at.pdf, F(0.0f)), expected_queries(b, ends, sequence),
          throughput_of(b, ends, sequence, p)};
}

template <class F>
TYNDALL_INLINE BsdfHitPath<F> bsdf_hit_by_mirror(const SpecularFlat<F>& m, const SpecularTrail<F>& trail,
                                                 const Ray<F>& ray, const LightColumns<F>& light, Vec3<F> point) {
  const LightPoint<F> at = light_point_at(light, {mirrored(m, trail.start), F(0.0f)}, trail.start, ray.time, point);
  const SpecularPath<F> path = mirror_path(m, trail.start, point);
  return bsdf_hit_by_flats(light, at, ray.direction, path.found, path.spread, F(1.0f));
}

template <class F>
TYNDALL_INLINE BsdfHitPath<F> bsdf_hit_by_slab(const SpecularFlat<F>& p, const SpecularTrail<F>& trail,
                                               const Ray<F>& ray, const LightColumns<F>& light, Vec3<F> point) {
  const SlabSequence<F> sequence = slab_sequence_of(p, trail.met, ray.direction);
  const BoundingSphere<F> around = bounding_sphere(light, ray.time);
  const SlabFrame<F> to_light = slab_frame(p, trail.start, around.center, sequence.across);
  const auto could = is_looked_for(p, to_light, around, sequence);
  const BoundingSphere<F> seen = seen_by_slab(p, to_light, sequence);
  const LightPoint<F> at = light_point_at(light, seen, seen.center, ray.time, point);
  const SlabFrame<F> s = slab_frame(p, trail.start, point, sequence.across);
  const F rises[3] = {dot(p.row[0], ray.direction), dot(p.row[1], ray.direction), dot(p.row[2], ray.direction)};
  const SlabPlace<F> rise = framed<F>(rises, sequence.across);
  const F slope =
      sqrt(mul_add(rise.side[0], rise.side[0], rise.side[1] * rise.side[1])) / max(abs(rise.height), F(1e-6f));
  const FramedPath<F> path = path_of_slope(s, sequence, slope);
  return bsdf_hit_by_flats(light, at, ray.direction, could, path.spread, path.throughput);
}

/// Weight, by the power heuristic, of a path that BSDF sampling found beside the specular path that could have.
template <class F>
TYNDALL_INLINE F weight_beside(const SpecularPairs& c, const SpecularTrail<F>& trail, const BsdfHitPath<F>& hit_path,
                               IntOf<F> pair, MaskOf<F> could) {
  const F probability = choice_probability(c, trail.start, pair);
  const F query_pdf = hit_path.pdf * probability * hit_path.queries;
  const F inverse = query_pdf / max(trail.pdf * hit_path.throughput, F(1e-37f));
  const auto competes = mask_and(could, less(F(0.0f), query_pdf));
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
  const SpecularPairs& c = s.specular;
  const I sphere = select(could, trail.met.object(), I(0));
  const I safe_light = select(could, light, I(0));
  const I pair = gather<F>(c.pair_of, sphere * I(s.lights.count()) + safe_light);
  could = mask_and(could, less_equal(I(0), pair));
  if (!any(could)) return F(1.0f);
  const LightColumns<F> columns = load_light<F>(s.lights, safe_light);
  BsdfHitPath<F> hit_path{F(0.0f), F(0.0f), F(0.0f)};
  if (c.has_spheres()) hit_path = bsdf_hit_by_sphere(c, trail, ray, sphere, columns, point);
  const auto is_flat = mask_and(could, less_equal(I(c.first_mirror), sphere));
  if (any(is_flat)) {
    const SpecularFlat<F> flat = load_flat<F>(c, select(is_flat, sphere - I(c.first_mirror), I(0)));
    const auto is_slab = mask_and(is_flat, less_equal(I(c.first_slab), sphere));
    const auto is_mirror = mask_and_not(is_flat, is_slab);
    const auto replace = [&](MaskOf<F> here, const BsdfHitPath<F>& by) __attribute__((always_inline)) {
      put<F>(here, by, hit_path, &BsdfHitPath<F>::pdf, &BsdfHitPath<F>::queries, &BsdfHitPath<F>::throughput);
    };
    if (any(is_mirror)) replace(is_mirror, bsdf_hit_by_mirror(flat, trail, ray, columns, point));
    if (any(is_slab)) replace(is_slab, bsdf_hit_by_slab(flat, trail, ray, columns, point));
  }
  return weight_beside(c, trail, hit_path, select(could, pair, I(0)), could);
}

/// mis_weight_of_bsdf_hit() of the sky, for rays that have left the scene in the lanes `escaped`.
template <class F>
[[gnu::noinline]] static F mis_weight_of_sun_hit(const SceneView& s, SpecularTrail<F> trail, Ray<F> ray,
                                                 MaskOf<F> escaped) {
  using I = IntOf<F>;
  const SpecularPairs& c = s.specular;
  auto could = mask_and(escaped, trail.met.has_object());
  if (!any(could)) return F(1.0f);
  const I sphere = select(could, trail.met.object(), I(0));
  const I pair = lookup<F>(c.sun_pair_of, c.spheres(), sphere);
  could = mask_and(could, less_equal(I(0), pair));
  if (!any(could)) return F(1.0f);
  const LightColumns<F> window = sun_window(s.sky, load_sphere<F>(c, sphere, ray.time));
  const F slope = dot(ray.direction, window.normal);
  const F t = dot(window.corner - ray.origin, window.normal) / max(slope, F(1e-30f));
  const Vec3<F> point = point_at(ray.origin, t, ray.direction), off = point - window.corner;
  const F across[] = {dot(off, window.edge_u), dot(off, window.edge_v)};
  for (const F& place : across)
    could = mask_and(could, mask_and(less_equal(F(0.0f), place), less_equal(place, window.length_u)));
  could = mask_and(could, mask_and(less(F(0.5f), slope), less(F(0.0f), t)));
  if (!any(could)) return F(1.0f);
  const BsdfHitPath<F> hit_path = bsdf_hit_by_sphere(c, trail, ray, sphere, window, point);
  return weight_beside(c, trail, hit_path, select(could, pair, I(0)), could);
}

}  // namespace tyndall
