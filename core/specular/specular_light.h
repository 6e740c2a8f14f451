#pragma once
#include "core/base/sampling.h"
#include "core/specular/request.h"
#include "core/specular/specular_trail.h"
#include "core/specular/sun_window.h"

/// Light from a small light that reaches a point through or off one sphere, one flat mirror or one slab, such as the
/// bright spot under a glass sphere. BSDF sampling seldom finds such paths, so they are solved for (manifold next event
/// estimation): choose a pair of an object and a light; for a slab, draw the event sequence; draw points of the light;
/// for a sphere, choose event sequences; solve for all paths; keep one, in proportion to its unoccluded contribution,
/// and test its visibility. BSDF sampling finds the same paths, so both are weighted by the power heuristic.
namespace tyndall {

/// The query of each lane: a sphere, mirror or slab, a light, a point of that light, and the geometry between them.
template <class F>
struct SpecularQuery {
  F probability;  ///< that a specular path is queried, times that of this pair
  SpecularSphere<F> sphere;
  SpecularFlat<F> flat;
  DrawnSlabSequence<F> slab_path;  ///< event sequence through the slab
  MaskOf<F> by_mirror, by_slab;
  IntOf<F> light;
  LightColumns<F> light_columns;
  BoundingSphere<F> seen;  ///< the sphere, or the image of the shading point, as the light sees it
  Vec3<F> receiver;        ///< the shading point; for slabs the centre of its image
  LightPoint<F> at;
  PathPlane<F> plane;
  PathEnds<F> ends;
};

/// Draws an event sequence through a slab.
template <class F>
TYNDALL_INLINE void query_slab(const SpecularRequest<F>& q, MaskOf<F> lanes, SpecularQuery<F>& a) {
  const BoundingSphere<F> around = bounding_sphere(a.light_columns, q.time);
  const Vec3<F> normal = select(q.in_medium, zero3<F>(), q.facing);
  const Pair<F> u{q.sampler.independent_1d(dimension::event_sequence),
                  q.sampler.independent_1d(dimension::specular_root)};
  a.slab_path = draw_slab_sequence(a.flat, q.point, normal, around, u, mask_and(lanes, a.by_slab));
  const SlabSequence<F>& sequence = a.slab_path.sequence;
  const auto seen = seen_by_slab(a.flat, slab_frame(a.flat, q.point, around.center, sequence.across), sequence);
  put<F>(a.by_slab, seen, a.seen, &BoundingSphere<F>::center, &BoundingSphere<F>::radius);
  a.receiver = select(a.by_slab, seen.center, a.receiver);
}

template <class F>
TYNDALL_INLINE SpecularQuery<F> specular_query(const auto& s, const SpecularRequest<F>& q, MaskOf<F> lanes) {
  const SpecularPairs& c = s.specular;
  SpecularQuery<F> a{};
  const LightChoice<F> pair = choose_light(c, q.point, q.sampler.independent_1d(dimension::specular_pair));
  a.probability = connect_probability(s, q.point) * pair.probability;
  const IntOf<F> sphere = lookup<F>(c.sphere, c.pairs(), pair.light);
  const IntOf<F> flat = sphere - IntOf<F>(c.first_mirror);
  const auto is_flat = less_equal(IntOf<F>(0), flat);
  a.sphere = load_sphere<F>(c, sphere, q.time);
  a.light = lookup<F>(c.light, c.pairs(), pair.light);
  a.light_columns = load_light_or_sun<F>(s, a.light, a.sphere);
  a.by_slab = less_equal(IntOf<F>(c.first_slab), sphere);
  a.by_mirror = mask_and_not(is_flat, a.by_slab);
  a.seen = {a.sphere.center, a.sphere.radius};
  a.receiver = q.point;
  if (c.has_mirrors() || c.has_slabs()) a.flat = load_flat<F>(c, select(is_flat, flat, IntOf<F>(0)));
  if (c.has_mirrors()) a.seen.center = select(a.by_mirror, mirrored(a.flat, q.point), a.seen.center);
  if (c.has_slabs() && any(mask_and(lanes, a.by_slab))) query_slab(q, lanes, a);
  return a;
}

/// The path by a sphere that was solved for.
template <class F>
TYNDALL_INLINE SpecularPath<F> sphere_path(const SpecularQuery<F>& a, const EventSequence<F>& sequence,
                                           const SolvedPath<F>& c) {
  const Deflection<F>& deflection = c.deflection;
  const F at = c.root.s, p = c.root.p;
  const auto ray = [&](F reach, F side, Vec3<F> out, Vec3<F> across) __attribute__((always_inline)) {
    const F inverse = F(1.0f) / reach, cosine = depth_of(deflection, reach, at) * inverse;
    return point_at((side * cosine) * out, c.root.sense * p * inverse, across);
  };
  SpecularPath<F> r;
  r.found = c.root.found;
  r.direction = ray(a.ends.near_reach, -c.sign.near, a.plane.near_out, a.plane.near_side);
  r.arrive = ray(a.ends.far_reach, c.sign.far, a.plane.far_out, a.plane.far_side);
  r.near_distance =
      distance_to_sphere(a.sphere, deflection, a.plane.near, a.ends.near_reach, c.sign.near, at, a.ends.near_in_glass);
  r.far_distance =
      distance_to_sphere(a.sphere, deflection, a.plane.far, a.ends.far_reach, c.sign.far, at, less(F(1.0f), F(0.0f)));
  const IntOf<F> wall = select(a.ends.deep, a.sphere.inner, a.sphere.outer);
  const auto near_in = less(a.plane.near, a.sphere.radius), far_in = less(a.plane.far, a.sphere.radius);
  r.wall =
      select(mask_and_not(near_in, mask_and(a.ends.near_in_glass, less(c.sign.near, F(0.0f)))), wall, a.sphere.outer);
  r.from = select(far_in, wall, a.sphere.outer) * IntOf<F>(4) + select(far_in, IntOf<F>(1), IntOf<F>(0));
  r.throughput = throughput_of(a.sphere, a.ends, sequence, p);
  r.queries = expected_queries(a.sphere, a.ends, sequence);
  const F cosine = light_cosine(a.light_columns, a.at.normal, r.arrive);
  r.spread = spread_of(deflection, a.ends, a.plane.sine, at, c.root.slope, cosine);
  return r;
}

/// One specular path per lane, drawn from all that were found in proportion to their weights. (J. Talbot, D. Cline, P.
/// Egbert, Importance Resampling for Global Illumination, Eurographics Symposium on Rendering 2005)
template <class F>
struct SampledPath {
  Reservoir<F> reservoir;
  SpecularPath<F> path{};
  Vec3<F> light_point{};   ///< where the path starts on the light
  PathEnds<F> ends{};      ///< set where the sphere is overlapped
  InsidePath<F> inside{};  ///< likewise
};

/// Offers a path. Its weight is a factor on the light's radiance if nothing blocks the path, and includes that of the
/// power heuristic. Returns which lanes take the path.
template <class F>
TYNDALL_INLINE MaskOf<F> offer_path(const auto& s, const SpecularRequest<F>& q, const SpecularQuery<F>& a,
                                    const SpecularPath<F>& path, SampledPath<F>& taken) {
  const F cosine = light_cosine(a.light_columns, a.at.normal, path.arrive);
  const F scattered = scattered_pdf(s, q, path.direction) * path.throughput;
  const auto useful = mask_and(mask_and(path.found, less(F(0.0f), cosine)), less(F(0.0f), scattered));
  const F pdf = path.spread * a.at.pdf * (a.probability * path.queries);
  const F ratio = scattered / max(pdf, F(1e-37f));
  // The weight is 0 at a caustic's edge, where the pdf is 0.
  const F weight = path.count / (ratio + F(1.0f) / max(ratio, F(1e-37f)));
  const auto counts = mask_and(useful, less(weight, F(1e30f)));
  const auto takes = taken.reservoir.offer(select(counts, weight, F(0.0f)));
  if (!any(takes)) return takes;
  using P = SpecularPath<F>;
  put<F>(takes, path, taken.path, &P::direction, &P::arrive, &P::near_distance, &P::far_distance, &P::wall, &P::from,
         &P::optical_depth);
  taken.light_point = select(takes, a.at.point, taken.light_point);
  return takes;
}

/// Stores the part inside the sphere of a path that was taken, for overlapped spheres. It is measured from the end
/// inside the sphere, from the far end if both are, or from the near end if both are outside.
template <class F>
TYNDALL_INLINE void keep_inside(const SpecularQuery<F>& a, const SolvedPath<F>& c, const EventSequence<F>& sequence,
                                MaskOf<F> lanes, SampledPath<F>& taken) {
  const SpecularSphere<F>& b = a.sphere;
  const F p = c.root.p, sense = c.root.sense;
  const auto from_far = mask_and_not(less(a.plane.far, b.radius), a.ends.both_out);
  const F reach = select(from_far, a.ends.far_reach, a.ends.near_reach);
  const F within = select(a.ends.deep, b.inner_index * b.inner_radius, b.index * b.radius);
  const F outside = deflection_above(p, reach) - deflection_above(p, b.radius);
  const F inside =
      mul_add(select(from_far, c.sign.far, c.sign.near), deflection_above(p, reach), deflection_above(p, within));
  using I = InsidePath<F>;
  using E = PathEnds<F>;
  const I path{select(from_far, a.plane.far_out, a.plane.near_out),
               select(from_far, -sense * a.plane.far_side, sense * a.plane.near_side), p,
               select(a.ends.both_out, outside, inside), same_sequence(sequence, main_sequence(b, a.ends))};
  put<F>(lanes, path, taken.inside, &I::out, &I::side, &I::p, &I::angle, &I::main);
  put<F>(lanes, a.ends, taken.ends, &E::both_out, &E::deep, &E::valid, &E::both_in, &E::near_in_glass);
}

/// Lets a path to the sun, in the lanes `here`, begin where it leaves the sphere. Between there and the sun's window
/// rounding would move that point by more than elsewhere.
template <class F>
TYNDALL_INLINE void begin_at_sphere(const SpecularQuery<F>& a, const SolvedPath<F>& c, MaskOf<F> here,
                                    SampledPath<F>& taken) {
  const Vec3<F> arrive = taken.path.arrive;
  const Vec3<F> across = point_at(-dot(arrive, a.plane.far_side) * a.plane.far_out, dot(arrive, a.plane.far_out),
                                  a.plane.far_side);  // at right angles to the ray
  const F p = c.root.p;
  const F forward = sqrt(max(mul_add(a.sphere.radius, a.sphere.radius, -(p * p)), F(0.0f)));
  const Vec3<F> point = point_at(point_at(a.sphere.center, forward, arrive), -c.root.sense * p, across);
  taken.light_point = select(here, point, taken.light_point);
  taken.path.far_distance = select(here, F(0.0f), taken.path.far_distance);
}

/// Offers all specular paths of an event sequence at a sphere. Both signs are tried for each end inside it (see
/// EndSigns), but for a near end in the glass of a shell, whose sign is the event sequence's.
template <class F>
TYNDALL_INLINE void offer_sequence(const auto& s, const SpecularRequest<F>& q, const SpecularQuery<F>& a,
                                   const EventSequence<F>& sequence, MaskOf<F> lanes, SampledPath<F>& taken) {
  const auto near_two = mask_and_not(less(a.plane.near, a.sphere.radius), a.ends.near_in_glass);
  const auto far_two = less(a.plane.far, a.sphere.radius);
  for (int i = 0; i < 4; ++i) {  // bit 0 of i: the near end's second sign; bit 1: the far end's
    auto here = lanes;
    if (i & 1) here = mask_and(here, near_two);
    if (i & 2) here = mask_and(here, far_two);
    if (!any(here)) continue;
    const F near_sign = select(a.ends.near_in_glass, sequence.near_sign, F(i & 1 ? -1.0f : 1.0f));
    const EndSigns<F> sign{near_sign, F(i & 2 ? -1.0f : 1.0f)};
    SolvedPath<F> c{deflection_of(s.specular, a.sphere, a.ends, sequence, sign), sign, {}};
    const DeflectionRoots<F> roots = list_roots(c.deflection, a.plane.angle, mask_and(here, c.deflection.possible));
    for (F index = F(0.0f); any(less(index, roots.count)); index = index + F(1.0f)) {
      c.root = take_root(c.deflection, roots, a.plane.angle, index);
      const auto takes = offer_path(s, q, a, sphere_path(a, sequence, c), taken),
                 overlapped = mask_and(takes, a.sphere.overlapped);
      if (s.specular.has_overlaps && any(overlapped)) keep_inside(a, c, sequence, overlapped, taken);
      if (s.has_sun_paths()) begin_at_sphere(a, c, mask_and(takes, is_sky<F>(a.light)), taken);
    }
  }
}

/// Offers the paths off a flat mirror and through a slab.
template <class F>
TYNDALL_INLINE void offer_flat(const auto& s, const SpecularRequest<F>& q, const SpecularQuery<F>& a, MaskOf<F> lanes,
                               IntOf<F> events_left, SampledPath<F>& taken) {
  const auto offer = [&](SpecularPath<F> path, MaskOf<F> here) __attribute__((always_inline)) {
    path.found = mask_and(path.found, here);
    path.spread = path.spread / max(light_cosine(a.light_columns, a.at.normal, path.arrive), F(1e-30f));
    offer_path(s, q, a, path, taken);
  };
  const auto by_mirror = mask_and(mask_and(lanes, a.by_mirror), less(IntOf<F>(1), events_left));
  if (s.specular.has_mirrors() && any(by_mirror)) offer(mirror_path(a.flat, q.point, a.at.point), by_mirror);
  if (!s.specular.has_slabs()) return;
  const SlabSequence<F>& sequence = a.slab_path.sequence;
  const F events = sequence.crossings + F(1.0f) + abs(sequence.image[0]) + abs(sequence.image[1]);
  const auto by_slab =
      mask_and(mask_and(mask_and(lanes, a.by_slab), a.slab_path.drawn), less(to_int(events), events_left));
  if (!any(by_slab)) return;
  const SlabFrame<F> frame = slab_frame(a.flat, q.point, a.at.point, sequence.across);
  SpecularPath<F> path = slab_path(a.flat, frame, sequence);
  path.count = F(1.0f) / max(a.slab_path.probability, F(1e-30f));
  offer(path, by_slab);
}

template <class F>
TYNDALL_INLINE SampledPath<F> sample_specular_path(const auto& s, const SpecularRequest<F>& q, SpecularQuery<F> a,
                                                   const Decisions<F>& decisions, MaskOf<F> lanes) {
  SampledPath<F> taken{{q.sampler.independent_1d(dimension::specular_root)}};
  const IntOf<F> events_left = IntOf<F>(s.max_depth) - q.depth;
  const auto by_sphere = mask_and_not(mask_and_not(lanes, a.by_mirror), a.by_slab);
  const Pair<F> u = q.sampler.next_2d(dimension::specular_point);
  const auto another = mask_and_not(by_sphere, a.sphere.mirror), twice = mask_and_not(another, a.sphere.hollow);
  for (int i = 0; i < 3; ++i) {  // main event sequence, again in solid glass, drawn one
    const auto here = i == 0 ? by_sphere : i == 1 ? twice : another;
    if (i > 0 && !any(here)) continue;
    const F shift = F(i == 0 ? 0.0f : 0.5f), x = u.x + shift, y = u.y + shift;
    const IntOf<F> light = s.has_sun_paths() ? select(is_sky<F>(a.light), IntOf<F>(0), a.light) : a.light;
    a.at = sample_light_point(s, light, a.light_columns, a.seen, a.receiver, q.time, {x - floor(x), y - floor(y)});
    if (s.specular.has_spheres()) {
      a.plane = plane_of(a.sphere, q.point, a.at.point);
      a.ends = ends_of(a.sphere, a.plane.near, a.plane.far);
    }
    if (i == 0) offer_flat(s, q, a, lanes, events_left, taken);
    if (!any(here)) break;
    const auto valid = mask_and(mask_and(here, a.ends.valid), less(F(1e-7f), a.plane.sine));
    const DrawnSequence<F> w =
        i < 2 ? DrawnSequence<F>{main_sequence(a.sphere, a.ends), valid} : draw_sequence(a.sphere, a.ends, decisions);
    const auto fits = less(to_int(w.sequence.outer + w.sequence.inner), events_left);
    offer_sequence(s, q, a, w.sequence, mask_and(mask_and(valid, w.drawn), fits), taken);
  }
  return taken;
}

/// Radiance with which a specular path starts.
template <class F>
TYNDALL_INLINE Vec3<F> radiance_at_end(const auto& s, IntOf<F> light, IntOf<F> element, const SampledPath<F>& taken,
                                       MaskOf<F> lanes) {
  if (!s.has_sun_paths()) return light_radiance(s, element, taken.light_point, lanes);
  const auto far = is_sky<F>(light), near = mask_and_not(lanes, far);
  const Vec3<F> sun = sky_towards(s.sky, taken.path.arrive).radiance;
  if (!any(near)) return sun;
  return select(far, sun, light_radiance(s, select(far, IntOf<F>(0), element), taken.light_point, near));
}

/// Radiance that reaches the requests' points by specular paths, times their throughput. Each visibility test of a lane
/// adds one to shadow_rays.
template <class F>
[[gnu::noinline]] static Vec3<F> specular_light(const auto& s, const SpecularRequest<F>& q, MaskOf<F> lanes,
                                                std::uint32_t& shadow_rays) {
  const SpecularQuery<F> a = specular_query<F>(s, q, lanes);
  const Decisions<F> decisions{q.sampler.independent_bits(dimension::event_sequence),
                               q.sampler.independent_bits(dimension::event_sequence_tail)};
  const SampledPath<F> taken = sample_specular_path(s, q, a, decisions, lanes);
  const SpecularPath<F>& found = taken.path;
  F weight = taken.reservoir.weight;
  auto arrives = less(F(0.0f), weight);
  if (!any(arrives)) return zero3<F>();
  const IntOf<F> light_element =
      s.has_sun_paths() ? element_of_light<F>(s, a.light) : lookup<F>(s.lights.element, s.lights.count(), a.light);
  const Ray<F> near{q.point, found.direction, q.time, q.from};
  const Ray<F> far{point_at(taken.light_point, -found.far_distance, found.arrive), found.arrive, q.time, found.from};
  for (int leg = 0; leg < 2; ++leg) {
    const Ray<F>& ray = leg == 0 ? near : far;
    F distance = leg == 0 ? found.near_distance : found.far_distance;
    if (s.has_sun_paths() && leg == 1) distance = select(is_sky<F>(a.light), F(__builtin_inff()), distance);
    shadow_rays += static_cast<std::uint32_t>(__builtin_popcount(bits(arrives)));
    arrives = mask_and_not(arrives,
                           call_blocked(shared_view(s), ray, distance, leg == 0 ? found.wall : light_element, arrives));
    if (!any(arrives)) return zero3<F>();
    if (s.has_media()) weight = weight * pass_media(s, ray, distance, arrives);
  }
  if (s.has_media() && s.specular.has_slabs()) weight = weight * transmittance(found.optical_depth);
  const auto overlapped = mask_and(arrives, a.sphere.overlapped);
  if (s.specular.has_overlaps && any(overlapped)) {
    const F passes = pass_inside(s, a.sphere, taken.ends, taken.inside, decisions, q.time, overlapped, shadow_rays);
    weight = select(overlapped, weight * passes, weight);
  }
  Vec3<F> colour = radiance_at_end(s, a.light, light_element, taken, arrives);
  const auto metal = mask_and(arrives, a.sphere.mirror);
  if (any(metal)) {
    const SurfacePoint<F> at = surface_at(s, near, found.near_distance, found.wall);
    colour = select(metal, colour * surface_colour(s, at, metal), colour);
  }
  return select(arrives, weight * (q.throughput * colour), zero3<F>());
}

}  // namespace tyndall
