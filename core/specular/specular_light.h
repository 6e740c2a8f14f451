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
  LightChoice<F> pair;
  F probability;  ///< that a specular path is queried, times that of this pair
  SpecularSphere<F> sphere;
  SpecularMirror<F> mirror;
  SpecularSlab<F> slab;
  DrawnSlabSequence<F> slab_path;  ///< event sequence through the slab
  MaskOf<F> by_mirror, by_slab;
  IntOf<F> light;
  LightColumns<F> light_columns;
  Vec3<F> receiver;  ///< the shading point; for slabs the centre of its image, see seen_by_slab()
  LightPoint<F> at;
  PathPlane<F> plane;
  PathEnds<F> ends;
};

/// Draws an event sequence through a slab. Returns the sphere in which the light sees the shading point through the
/// slab.
template <class F>
TYNDALL_INLINE SpecularSphere<F> query_slab(const auto& s, const SpecularRequest<F>& q, MaskOf<F> lanes,
                                            SpecularQuery<F>& a) {
  const SpecularView& c = s.specular;
  a.slab = load_slab<F>(
      c, select(a.by_slab, lookup<F>(c.sphere, c.pairs, a.pair.light) - IntOf<F>(c.first_slab), IntOf<F>(0)));
  const BoundingSphere<F> around = bounding_sphere(a.light_columns, q.time);
  const Vec3<F> normal = select(q.in_medium, zero3<F>(), q.facing);
  const Pair<F> u{q.sampler.independent_1d(dimension::event_sequence),
                  q.sampler.independent_1d(dimension::specular_root)};
  a.slab_path = draw_slab_sequence(a.slab, q.point, normal, around, u, mask_and(lanes, a.by_slab));
  return seen_by_slab(a.slab, slab_frame(a.slab, q.point, around.center, a.slab_path.sequence.across),
                      a.slab_path.sequence);
}

template <class F>
TYNDALL_INLINE SpecularQuery<F> specular_query(const auto& s, const SpecularRequest<F>& q, MaskOf<F> lanes) {
  const SpecularView& c = s.specular;
  const Vec3<F> point = q.point;
  SpecularQuery<F> a{};
  a.pair = choose_light(c, point, q.sampler.independent_1d(dimension::specular_pair));
  a.probability = connect_probability(s, point) * a.pair.probability;
  const IntOf<F> sphere = lookup<F>(c.sphere, c.pairs, a.pair.light), mirror = sphere - IntOf<F>(c.first_mirror);
  a.sphere = load_sphere<F>(c, sphere, q.time);
  a.light = lookup<F>(c.light, c.pairs, a.pair.light);
  a.light_columns = load_light_or_sun<F>(s, a.light, a.sphere);
  a.by_slab = less_equal(IntOf<F>(c.first_slab), sphere);
  a.by_mirror = mask_and_not(less_equal(IntOf<F>(0), mirror), a.by_slab);
  if (c.has_mirrors()) {
    a.mirror = load_mirror<F>(c, select(a.by_mirror, mirror, IntOf<F>(0)));
    a.sphere.center = select(a.by_mirror, mirrored(a.mirror, point), a.sphere.center);  // see seen_by_mirror()
  }
  a.receiver = point;
  if (c.has_slabs() && any(mask_and(lanes, a.by_slab))) {
    const SpecularSphere<F> seen = query_slab(s, q, lanes, a);
    a.sphere.center = select(a.by_slab, seen.center, a.sphere.center);
    a.sphere.radius = select(a.by_slab, seen.radius, a.sphere.radius);
    a.receiver = select(a.by_slab, seen.center, a.receiver);
  }
  return a;
}

/// Draws a point of the light into `a`, and updates the plane and the ends of the path.
template <class F>
TYNDALL_INLINE void aim_at_light(const auto& s, Vec3<F> point, F time, Pair<F> u, SpecularQuery<F>& a) {
  const IntOf<F> light = s.has_sun_paths() ? select(is_sky<F>(a.light), IntOf<F>(0), a.light) : a.light;
  a.at = sample_light_point(s, light, a.light_columns, a.sphere, a.receiver, time, u);
  if (!s.specular.has_spheres()) return;
  a.plane = plane_of(a.sphere, point, a.at.point);
  a.ends = ends_of(a.sphere, a.plane.near, a.plane.far);
}

template <class F>
TYNDALL_INLINE SpecularRays<F> rays_of(const SpecularQuery<F>& a, const EventSequence<F>& sequence,
                                       const SolvedPath<F>& c) {
  const Deflection<F>& deflection = c.path.deflection;
  const F at = c.root.s, p = deflection.maximum * (F(1.0f) - at * at);
  const auto ray = [&](F reach, F side, Vec3<F> out, Vec3<F> across) __attribute__((always_inline)) {
    const F inverse = F(1.0f) / reach, cosine = depth_of(deflection, reach, at) * inverse;
    return point_at((side * cosine) * out, c.root.sense * p * inverse, across);
  };
  SpecularRays<F> r;
  r.found = c.root.found, r.count = F(1.0f), r.optical_depth = F(0.0f);
  r.direction = ray(a.ends.near_reach, -c.sign.near, a.plane.near_out, a.plane.near_side);
  r.arrive = ray(a.ends.far_reach, c.sign.far, a.plane.far_out, a.plane.far_side);
  r.near_distance =
      distance_to_sphere(a.sphere, deflection, a.ends.near, a.ends.near_reach, c.sign.near, at, a.ends.near_in_glass);
  r.far_distance =
      distance_to_sphere(a.sphere, deflection, a.ends.far, a.ends.far_reach, c.sign.far, at, less(F(1.0f), F(0.0f)));
  const IntOf<F> wall = select(a.ends.deep, a.sphere.inner, a.sphere.outer);
  const auto near_in = less(a.plane.near, a.sphere.radius), far_in = less(a.plane.far, a.sphere.radius);
  r.wall =
      select(mask_and_not(near_in, mask_and(a.ends.near_in_glass, less(c.sign.near, F(0.0f)))), wall, a.sphere.outer);
  r.from = select(far_in, wall, a.sphere.outer) * IntOf<F>(4) + select(far_in, IntOf<F>(1), IntOf<F>(0));
  r.throughput = throughput_of(a.sphere, a.ends, sequence, p);
  const F cosine = light_cosine(a.light_columns, a.at.normal, r.arrive);
  const F spread = spread_of(c.path, a.ends, a.plane.sine, at, c.root.slope, cosine);
  r.pdf = spread * a.at.pdf * (a.probability * expected_queries(a.sphere, a.ends, sequence));
  return r;
}

/// The rays of a path between flat faces, which go on with the light's spread alone: off a mirror or through a slab.
template <class F>
TYNDALL_INLINE SpecularRays<F> rays_by_faces(const SpecularQuery<F>& a, const auto& path) {
  const F cosine = light_cosine(a.light_columns, a.at.normal, path.arrive);
  SpecularRays<F> r;
  r.found = path.found, r.direction = path.direction, r.arrive = path.arrive;
  r.near_distance = path.near_distance, r.far_distance = path.far_distance;
  r.pdf = path.spread / max(cosine, F(1e-30f)) * a.at.pdf * a.probability;
  r.throughput = F(1.0f), r.count = F(1.0f), r.optical_depth = F(0.0f);
  return r;
}

template <class F>
TYNDALL_INLINE SpecularRays<F> rays_off_mirror(const SpecularQuery<F>& a, Vec3<F> point) {
  const MirrorPath<F> path = mirror_path(a.mirror, point, a.at.point);
  SpecularRays<F> r = rays_by_faces(a, path);
  r.wall = a.sphere.outer, r.from = a.sphere.outer * IntOf<F>(4) + select(path.behind, IntOf<F>(1), IntOf<F>(0));
  return r;
}

template <class F>
TYNDALL_INLINE SpecularRays<F> rays_through_slab(const SpecularQuery<F>& a, Vec3<F> point) {
  const SlabFrame<F> s = slab_frame(a.slab, point, a.at.point, a.slab_path.sequence.across);
  const SlabPath<F> path = slab_path(a.slab, s, a.slab_path.sequence);
  // The two faces across one edge are elements that follow each other, the lower one first.
  const IntOf<F> lower = a.slab.element + a.slab_path.sequence.across + a.slab_path.sequence.across;
  const IntOf<F> upper = lower + IntOf<F>(1);
  SpecularRays<F> r = rays_by_faces(a, path);
  r.wall = select(less(F(0.0f), s.near.height), upper, lower);
  r.from = select(less(F(0.0f), s.far.height), upper, lower) * IntOf<F>(4);
  r.throughput = path.throughput, r.count = F(1.0f) / max(a.slab_path.probability, F(1e-30f));
  r.optical_depth = a.slab.medium_density * path.within;
  return r;
}

/// Factor on the light's radiance if nothing blocks the path. It includes the weight of the power heuristic.
template <class F>
TYNDALL_INLINE F weight_of(const auto& s, const SpecularRequest<F>& q, const SpecularQuery<F>& a,
                           const SpecularRays<F>& rays) {
  const F cosine = light_cosine(a.light_columns, a.at.normal, rays.arrive);
  const F scattered = scattered_pdf(s, q, rays.direction) * rays.throughput;
  const auto useful = mask_and(mask_and(rays.found, less(F(0.0f), cosine)), less(F(0.0f), scattered));
  const F ratio = scattered / max(rays.pdf, F(1e-37f));
  // The weight is 0 at a caustic's edge, where the pdf is 0.
  const F weight = rays.count / (ratio + F(1.0f) / max(ratio, F(1e-37f)));
  return select(mask_and(useful, less(weight, F(1e30f))), weight, F(0.0f));
}

/// One specular path per lane, drawn from all that were found in proportion to their weights. (J. Talbot, D. Cline, P.
/// Egbert, Importance Resampling for Global Illumination, Eurographics Symposium on Rendering 2005)
template <class F>
struct SampledPath {
  Reservoir<F> reservoir;
  SpecularRays<F> rays{};
  Vec3<F> light_point{};   ///< where the path starts on the light
  PathEnds<F> ends{};      ///< set where the sphere is overlapped
  InsidePath<F> inside{};  ///< likewise
};

/// Offers the rays with the weight of weight_of(). Returns which lanes take them.
template <class F>
TYNDALL_INLINE MaskOf<F> offer_rays(const auto& s, const SpecularRequest<F>& q, const SpecularQuery<F>& a,
                                    const SpecularRays<F>& rays, SampledPath<F>& taken) {
  const auto takes = taken.reservoir.offer(weight_of(s, q, a, rays));
  if (!any(takes)) return takes;
  const auto put = [takes](const auto& from, auto& to) __attribute__((always_inline)) { to = select(takes, from, to); };
  SpecularRays<F>& r = taken.rays;
  put(rays.direction, r.direction), put(rays.arrive, r.arrive), put(rays.near_distance, r.near_distance);
  put(rays.far_distance, r.far_distance), put(rays.wall, r.wall), put(rays.from, r.from),
      put(rays.optical_depth, r.optical_depth);
  put(a.at.point, taken.light_point);
  return takes;
}

/// Stores the part inside the sphere of a path that was taken, for overlapped spheres.
template <class F>
TYNDALL_INLINE void keep_inside(const SpecularQuery<F>& a, const SolvedPath<F>& c, const EventSequence<F>& sequence,
                                MaskOf<F> lanes, SampledPath<F>& taken) {
  const F p = c.path.deflection.maximum * (F(1.0f) - c.root.s * c.root.s);
  put(lanes, inside_path(a.sphere, a.plane, a.ends, c.sign.near, c.sign.far, c.root.sense, p, sequence), taken.inside);
  const auto copy = [lanes](const auto& from, auto& mask) __attribute__((always_inline)) {
    mask = mask_or(mask_and(lanes, from), mask_and_not(mask, lanes));
  };
  PathEnds<F>& ends = taken.ends;
  copy(a.ends.both_out, ends.both_out), copy(a.ends.deep, ends.deep), copy(a.ends.valid, ends.valid);
  copy(a.ends.both_in, ends.both_in), copy(a.ends.near_in_glass, ends.near_in_glass);
}

/// Lets a path to the sun, in the lanes `here`, begin where it leaves the sphere. Between there and the sun's window
/// rounding would move that point by more than elsewhere.
template <class F>
TYNDALL_INLINE void begin_at_sphere(const SpecularQuery<F>& a, const SolvedPath<F>& c, MaskOf<F> here,
                                    SampledPath<F>& taken) {
  const Vec3<F> arrive = taken.rays.arrive;
  const Vec3<F> across = point_at(-dot(arrive, a.plane.far_side) * a.plane.far_out, dot(arrive, a.plane.far_out),
                                  a.plane.far_side);  // at right angles to the ray
  const F p = c.path.deflection.maximum * (F(1.0f) - c.root.s * c.root.s);
  const F forward = sqrt(max(mul_add(a.sphere.radius, a.sphere.radius, -(p * p)), F(0.0f)));
  const Vec3<F> point = point_at(point_at(a.sphere.center, forward, arrive), -c.root.sense * p, across);
  taken.light_point = select(here, point, taken.light_point);
  taken.rays.far_distance = select(here, F(0.0f), taken.rays.far_distance);
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
    const DeflectionRoots<F> roots = list_roots(c.path.deflection, a.plane.angle, mask_and(here, c.path.possible));
    for (F index = F(0.0f); any(less(index, roots.count)); index = index + F(1.0f)) {
      c.root = take_root(c.path.deflection, roots, a.plane.angle, index);
      const auto takes = offer_rays(s, q, a, rays_of(a, sequence, c), taken),
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
  const auto by_mirror = mask_and(mask_and(lanes, a.by_mirror), less(IntOf<F>(1), events_left));
  if (s.specular.has_mirrors() && any(by_mirror)) {
    SpecularRays<F> rays = rays_off_mirror(a, q.point);
    rays.found = mask_and(rays.found, by_mirror);
    offer_rays(s, q, a, rays, taken);
  }
  if (!s.specular.has_slabs()) return;
  const SlabSequence<F>& sequence = a.slab_path.sequence;
  const F events = sequence.crossings + F(1.0f) + abs(sequence.image[0]) + abs(sequence.image[1]);
  const auto by_slab =
      mask_and(mask_and(mask_and(lanes, a.by_slab), a.slab_path.drawn), less(to_int(events), events_left));
  if (!any(by_slab)) return;
  SpecularRays<F> rays = rays_through_slab(a, q.point);
  rays.found = mask_and(rays.found, by_slab);
  offer_rays(s, q, a, rays, taken);
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
    aim_at_light(s, q.point, q.time, {x - floor(x), y - floor(y)}, a);
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
  const Vec3<F> sun = sky_towards(s.sky, taken.rays.arrive).radiance;
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
  const SpecularRays<F>& found = taken.rays;
  F weight = taken.reservoir.weight;
  auto arrives = less(F(0.0f), weight);
  if (!any(arrives)) return zero3<F>();
  const IntOf<F> light_element =
      s.has_sun_paths() ? element_of_light<F>(s, a.light) : lookup<F>(s.lights.element, s.lights.count, a.light);
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
