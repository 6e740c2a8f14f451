#pragma once
#include "core/kernel/camera.h"
#include "core/kernel/lights.h"
#include "core/kernel/shade.h"
#include "core/media/medium.h"

/// The path loop: a group of lanes, each following its own path; a lane whose path has ended takes the next camera ray.
namespace tyndall {

/// Everything a group of paths carries from event to event.
template <class F>
struct Paths {
  Ray<F> ray;
  Vec3<F> throughput, radiance;
  Dice<F> dice;
  IntOf<F> depth;  ///< scattering events so far
  F density;       ///< of the ray's direction, per steradian; one_direction: light sampling could not have chosen it
  std::int32_t slot[lanes_of<F>];
  std::uint32_t half[lanes_of<F>];
  std::uint32_t alive = 0;  ///< a bit a lane
};

/// Gives free lanes a camera ray each, as long as there are samples.
template <class F>
TYNDALL_INLINE void take_samples(Paths<F>& p, CameraQueue<F>& queue, UnitSamples& samples, const SceneView& s,
                                 const Unit& unit) {
  constexpr std::uint32_t full = lanes_of<F> == 32 ? 0xffffffffu : (1u << (lanes_of<F> % 32)) - 1u;
  while (p.alive != full) {
    if (queue.next == queue.end) {
      if (samples.empty()) return;
      refill(queue, samples, s, unit);
    }
    alignas(64) std::int32_t from[lanes_of<F>] = {};
    std::uint32_t fresh = 0;
    for (std::uint32_t free = full & ~p.alive; free && queue.next < queue.end; free &= free - 1, ++queue.next) {
      const int lane = __builtin_ctz(free);
      from[lane] = queue.next;
      p.slot[lane] = queue.slot[queue.next];
      p.half[lane] = queue.half[queue.next];
      fresh |= 1u << lane;
    }
    const auto m = mask_from_bits<F>(fresh);
    const IntOf<F> at = load_int<F>(from);
    const auto take = [&](const float* column, F old) { return select(m, gather<F>(column, at), old); };
    p.ray.origin = {take(queue.ox, p.ray.origin.x), take(queue.oy, p.ray.origin.y), take(queue.oz, p.ray.origin.z)};
    p.ray.direction = {take(queue.dx, p.ray.direction.x), take(queue.dy, p.ray.direction.y),
                       take(queue.dz, p.ray.direction.z)};
    p.ray.time = take(queue.time, p.ray.time);
    p.ray.from = select(m, IntOf<F>(from_nowhere), p.ray.from);
    p.dice.low = select(m, as_uint(gather_int<F>(queue.low, at)), p.dice.low);
    p.dice.high = select(m, as_uint(gather_int<F>(queue.high, at)), p.dice.high);
    p.dice.event = select(m, UintOf<F>(dimension::camera_count * golden_ratio), p.dice.event);
    p.throughput = select(m, Vec3<F>{F(1.0f), F(1.0f), F(1.0f)}, p.throughput);
    p.radiance = select(m, zero3<F>(), p.radiance);
    p.depth = select(m, IntOf<F>(0), p.depth);
    p.density = select(m, F(one_direction), p.density);
    p.alive |= fresh;
  }
}

/// The part of a ray within a medium's boundary.
template <class F>
TYNDALL_INLINE Interval<F> within_medium(const MediumColumns& m, const Ray<F>& ray) {
  const Start<F> start = start_on<F>(ray.from, m.first, m.count);
  if (m.box) {
    const Interval<F> line = box_slabs(m.map, ray.origin, ray.direction).inside;
    return any(start.here) ? leave_box(line, start) : line;
  }
  const Vec3<F> to_center = splat<F>(m.center) - ray.origin;
  const Interval<F> line = sphere_interval(to_center, splat<F>(m.radius), ray.direction);
  return any(start.here) ? leave_sphere(line, to_center, ray.direction, ray.from, start) : line;
}

/// Where a path scatters within a medium, if it does.
template <class F>
struct MediumEvent {
  MaskOf<F> happens;
  IntOf<F> from;  ///< Ray::from of a start within the medium
  Vec3<F> albedo;
  IntOf<F> texture;
  F g;
};

/// The nearest of the media's independent exponential flights, if it ends before the surface: right for media that
/// overlap, whose densities add. Shortens `nearest` to it.
template <class F>
TYNDALL_INLINE MediumEvent<F> fly_through_media(const SceneView& s, const Ray<F>& ray, const Dice<F>& dice,
                                                MaskOf<F> active, F& nearest) {
  const F infinity = F(__builtin_inff());
  MediumEvent<F> event{less(F(1.0f), F(0.0f)), IntOf<F>(from_nowhere), zero3<F>(), IntOf<F>(-1), F(0.0f)};
  for (int k = 0; k < s.medium_count; ++k) {
    const MediumColumns& m = s.media[k];
    const Interval<F> inside = within_medium(m, ray);
    const F begin = max(inside.near, F(0.0f)), end = min(inside.far, nearest);
    const auto crosses = mask_and(mask_and(inside.hit, active), less(begin, end));
    if (!any(crosses)) continue;
    const F t =
        begin + free_flight(splat<F>(m.density), dice.open(dimension::free_flight, static_cast<std::uint32_t>(k)));
    const auto here = mask_and(mask_and(crosses, less(t, end)), less(t, infinity));
    nearest = select(here, t, nearest);
    event.happens = mask_or(event.happens, here);
    event.from = select(here, IntOf<F>(4 * m.first + static_cast<std::int32_t>(Side::within)), event.from);
    event.albedo = select(here, splat<F>(m.albedo), event.albedo);
    event.texture = select(here, IntOf<F>(m.texture), event.texture);
    event.g = select(here, splat<F>(m.g), event.g);
  }
  return event;
}

/// Share of light that passes all media on the way to `distance`.
template <class F>
TYNDALL_INLINE F pass_media(const SceneView& s, const Ray<F>& ray, F distance, MaskOf<F> active) {
  F depth = F(0.0f);
  for (int k = 0; k < s.medium_count; ++k) {
    const Interval<F> inside = within_medium(s.media[k], ray);
    const F begin = max(inside.near, F(0.0f)), end = min(inside.far, distance);
    const auto crosses = mask_and(mask_and(inside.hit, active), less(begin, end));
    if (any(crosses)) depth = select(crosses, mul_add(end - begin, splat<F>(s.media[k].density), depth), depth);
  }
  return any(less(F(0.0f), depth)) ? transmittance(depth) : F(1.0f);
}

/// What a group of lanes is at: surfaces and points in media, ready to scatter.
template <class F>
struct Event {
  MaskOf<F> surface, medium;  ///< lanes; never both
  Vec3<F> point;
  Vec3<F> colour;  ///< albedo
  IntOf<F> from;   ///< Ray::from on the side that the ray came from, or within the medium
  Incident<F> incident;
  SurfacePoint<F> at;
  IntOf<F> kind;  ///< of the material
  F g;
};

/// Light that lanes see directly from an event, by one sample of one light, weighed against what scattering would have
/// found by itself. E. Veach, Robust Monte Carlo Methods for Light Transport Simulation, 1997, section 9.2: the power
/// heuristic, written in the ratio r of the two densities: r² / (1 + r²) and 1 / (1 + r²).
template <class F>
TYNDALL_INLINE Vec3<F> direct_light(const SceneView& s, const Paths<F>& p, const Event<F>& e, MaskOf<F> lanes,
                                    std::uint32_t& shadows) {
  const LightChoice<F> choice = choose_light(s.lights, e.point, p.dice.one(dimension::light_choice));
  const LightSample<F> sample =
      sample_light(s.lights, choice.light, e.point, p.ray.time, p.dice.pair(dimension::light_point));
  F scattered = F(0.0f);
  if (any(e.surface)) scattered = density_any(s, e.at.material, e.kind, e.surface, e.incident, sample.direction);
  if (s.needs.media && any(e.medium))
    scattered = select(e.medium, henyey_greenstein_density(e.g, dot(p.ray.direction, sample.direction)), scattered);
  const F chosen = sample.density * choice.probability;
  const auto useful = mask_and(lanes, mask_and(less(F(0.0f), scattered), less(F(0.0f), chosen)));
  if (!any(useful)) return zero3<F>();
  shadows = bits(useful);
  const Ray<F> ray{e.point, sample.direction, p.ray.time, e.from};
  const IntOf<F> element =
      s.lights.count == 1 ? IntOf<F>(s.lights.element[0]) : gather_int<F>(s.lights.element, choice.light);
  const auto arrives = mask_and_not(useful, blocked(s, ray, sample.distance, element, useful));
  if (!any(arrives)) return zero3<F>();
  const F ratio = scattered / select(useful, chosen, F(1.0f));
  F weight = s.multiple_importance ? ratio / mul_add(ratio, ratio, F(1.0f)) : ratio;
  if (s.needs.media) weight = weight * pass_media(s, ray, sample.distance, arrives);
  const Vec3<F> radiance = light_radiance(s, element, along(e.point, sample.distance, sample.direction), arrives);
  return select(arrives, weight * (p.throughput * e.colour * radiance), zero3<F>());
}

/// Weight of a light that a ray met by itself.
template <class F>
TYNDALL_INLINE F found_light_weight(const SceneView& s, const Paths<F>& p, IntOf<F> element, F distance,
                                    MaskOf<F> lit) {
  const auto could = mask_and(lit, less(F(0.0f), p.density));
  if (!s.light_sampling || !any(could)) return F(1.0f);
  if (!s.multiple_importance) return select(could, F(0.0f), F(1.0f));
  const IntOf<F> light = gather_int<F>(s.light_of, element);
  const IntOf<F> safe = select(less(light, IntOf<F>(0)), IntOf<F>(0), light);
  const F chosen = light_density(s.lights, safe, p.ray.origin, p.ray.time, p.ray.direction, distance);
  const F ratio = p.density / max(chosen, F(1e-30f));
  const F other = F(1.0f) / mul_add(ratio, ratio, F(1.0f));
  return select(could, F(1.0f) - other, F(1.0f));
}

/// Adds what lanes on a light see, and fills the event of the others.
template <class F>
TYNDALL_INLINE void meet_surfaces(const SceneView& s, Paths<F>& p, const Hit<F>& hit, Vec3<F> unit, Event<F>& e) {
  e.at = surface_at(s, p.ray, hit.t, hit.element);
  e.kind = gather_int<F>(s.kind, e.at.material);
  const Vec3<F> colour = surface_colour(s, e.at, e.surface);
  const auto lit = mask_and(e.surface, equal(e.kind, IntOf<F>(kind_of<Light<double>>())));
  if (any(lit)) {
    const F weight = found_light_weight(s, p, e.at.element, hit.t, lit);
    p.radiance = select(lit, p.radiance + weight * (p.throughput * colour), p.radiance);
  }
  e.surface = mask_and_not(e.surface, lit);
  const F towards = dot(p.ray.direction, e.at.normal);
  const auto along_normal = less(F(0.0f), towards);
  const Vec3<F> facing = select(along_normal, -e.at.normal, e.at.normal);
  e.incident = {p.ray.direction, e.at.normal, facing,    min(abs(towards), F(1.0f)),
                along_normal,    unit,        s.schlick, &p.dice};
  const IntOf<F> one = IntOf<F>(1), zero = IntOf<F>(0);
  const IntOf<F> inside = select(along_normal, select(e.at.inverted, zero, one), select(e.at.inverted, one, zero));
  e.point = select(e.surface, e.at.point, e.point);
  e.colour = select(e.surface, colour, e.colour);
  e.from = select(e.surface, e.at.element * IntOf<F>(4) + inside, e.from);
}

template <class F>
TYNDALL_INLINE void meet_media(const SceneView& s, const Paths<F>& p, const MediumEvent<F>& found, F t, Event<F>& e) {
  const Vec3<F> point = along(p.ray.origin, select(e.medium, t, F(0.0f)), p.ray.direction);
  Vec3<F> albedo = found.albedo;
  if (s.needs.textures) albedo = textured<F>(s, albedo, found.texture, e.medium, point, nullptr);
  e.point = select(e.medium, point, e.point);
  e.colour = select(e.medium, albedo, e.colour);
  e.from = select(e.medium, found.from, e.from);
  e.g = found.g;
}

/// New directions; answers which lanes go on.
template <class F>
TYNDALL_INLINE MaskOf<F> scatter(const SceneView& s, Paths<F>& p, const Event<F>& e, Vec3<F> unit, Pair<F> u) {
  const Vec3<F> before = p.ray.direction;
  MaskOf<F> goes_on = e.medium;
  p.ray.origin = e.point;
  p.ray.from = e.from;
  if (any(e.surface)) {
    const Scattered<F> out = scatter_any(s, e.at.material, e.kind, e.surface, e.incident);
    p.ray.direction = select(e.surface, out.direction, p.ray.direction);
    p.density = select(e.surface, out.density, p.density);
    // Through the surface: on its other side, inside for outside.
    const auto through = mask_and(e.surface, out.transmitted);
    const IntOf<F> side = e.from & IntOf<F>(1);
    p.ray.from = select(through, e.from + IntOf<F>(1) - (side + side), p.ray.from);
    goes_on = mask_or(goes_on, mask_and_not(e.surface, out.absorbed));
  }
  if (s.needs.media && any(e.medium)) {
    Vec3<F> direction = unit;
    if (s.needs.phase_functions) direction = scatter_in_medium(e.g, before, unit, u);
    p.ray.direction = select(e.medium, direction, p.ray.direction);
    p.density = select(e.medium, henyey_greenstein_density(e.g, dot(before, direction)), p.density);
  }
  return goes_on;
}

/// Ends paths with a probability that grows as they carry less: survivors carry what the ended ones would have.
/// The factor 6 keeps paths above a sixth of full throughput; between 4 and 8 the time to a given error is flat.
template <class F>
TYNDALL_INLINE MaskOf<F> roulette(Paths<F>& p, MaskOf<F> lanes) {
  const F survival = F(6.0f) * max_component(p.throughput);
  const auto at_risk = mask_and(lanes, less(survival, F(1.0f)));
  if (!any(at_risk)) return lanes;
  const auto ended = mask_and_not(at_risk, less(p.dice.one(dimension::roulette), survival));
  const F scale = F(1.0f) / select(at_risk, max(survival, F(1e-37f)), F(1.0f));
  p.throughput = select(at_risk, scale * p.throughput, p.throughput);
  return mask_and_not(lanes, ended);
}

/// Lanes whose state is not finite, as `part` of it shows: their radiance becomes one that the film rejects and counts.
template <class F>
TYNDALL_INLINE MaskOf<F> lose(Paths<F>& p, MaskOf<F> lanes, Vec3<F> part) {
  const F sum = F(0.0f) * part.x + F(0.0f) * part.y + F(0.0f) * part.z;  // 0, or not a number
  const auto lost = mask_and_not(lanes, equal(sum, F(0.0f)));
  if (any(lost)) p.radiance = select(lost, Vec3<F>{sum, sum, sum}, p.radiance);
  return lost;
}

/// One step of all lanes: to the next surface, event in a medium, or out. Answers which lanes go on; `cut` are those
/// that max_depth ended.
template <class F>
TYNDALL_INLINE MaskOf<F> step(const SceneView& s, Paths<F>& p, MaskOf<F> active, MaskOf<F>& cut,
                              std::uint32_t& shadows) {
  const MaskOf<F> none = less(F(1.0f), F(0.0f));
  Hit<F> hit = closest(s, p.ray, active);
  MediumEvent<F> found{none, IntOf<F>(0), zero3<F>(), IntOf<F>(-1), F(0.0f)};
  if (s.needs.media) found = fly_through_media(s, p.ray, p.dice, active, hit.t);
  Event<F> e{};
  e.medium = found.happens;
  e.surface = mask_and(active, mask_and_not(less_equal(IntOf<F>(0), hit.element), e.medium));
  e.point = p.ray.origin, e.colour = zero3<F>(), e.from = p.ray.from;
  const auto escaped = mask_and_not(mask_and_not(active, e.surface), e.medium);
  if (s.needs.background && any(escaped))
    p.radiance =
        select(escaped, p.radiance + p.throughput * background_radiance(s.background, p.ray.direction), p.radiance);
  const Pair<F> u = p.dice.pair(dimension::direction);
  const Vec3<F> unit = on_sphere(u);
  if (any(e.surface)) meet_surfaces(s, p, hit, unit, e);
  if (s.needs.media && any(e.medium)) meet_media(s, p, found, hit.t, e);
  const auto met = mask_or(e.surface, e.medium);
  const Vec3<F> carried = p.throughput * e.colour;
  const auto lost = lose(p, met, carried + e.point);
  // A path that carries nothing has ended, not been cut.
  const auto useful = mask_and(mask_and_not(met, lost), less(F(0.0f), max_component(carried)));
  const auto deep = less_equal(IntOf<F>(s.max_depth), p.depth);
  cut = mask_and(useful, deep);
  const auto scattering = mask_and_not(useful, deep);
  if (s.light_sampling && any(scattering)) p.radiance = p.radiance + direct_light(s, p, e, scattering, shadows);
  const auto on = mask_and(scattering, scatter(s, p, e, unit, u));
  const auto lanes = mask_and_not(on, lose(p, on, p.ray.direction));
  p.throughput = select(lanes, carried, p.throughput);
  p.depth = p.depth + IntOf<F>(1);
  const auto survivors = roulette(p, lanes);
  p.dice.next_event();
  return survivors;
}

/// Adds the samples of finished lanes to the unit's pixels.
template <class F>
TYNDALL_INLINE void finish(const Paths<F>& p, std::uint32_t finished, std::uint32_t cut, double per_unit,
                           FilmPixel* pixels) {
  if (!finished) return;
  alignas(64) float r[lanes_of<F>], g[lanes_of<F>], b[lanes_of<F>];
  store(r, p.radiance.x), store(g, p.radiance.y), store(b, p.radiance.z);
  for (; finished; finished &= finished - 1) {
    const int lane = __builtin_ctz(finished);
    FilmPixel& pixel = pixels[p.slot[lane]];
    add_sample(pixel, p.half[lane], {r[lane], g[lane], b[lane]}, per_unit);
    ++pixel.taken;
    pixel.truncated += cut >> lane & 1u;
  }
}

template <class F>
TYNDALL_INLINE void render_unit(const SceneView& s, const Unit& unit, double film_unit, FilmPixel* pixels,
                                UnitCounts& counts) {
  UnitSamples samples;
  list_samples(unit, samples);
  CameraQueue<F> queue;
  Paths<F> p{};
  p.dice.sobol = s.sobol;
  const double per_unit = 1 / film_unit;
  for (;;) {
    take_samples(p, queue, samples, s, unit);
    if (!p.alive) return;
    counts.rays += static_cast<std::uint64_t>(__builtin_popcount(p.alive));
    MaskOf<F> cut;
    std::uint32_t shadows = 0;
    const std::uint32_t survivors = bits(step(s, p, mask_from_bits<F>(p.alive), cut, shadows)) & p.alive;
    const auto shadow_rays = static_cast<std::uint64_t>(__builtin_popcount(shadows));
    counts.rays += shadow_rays;
    counts.shadow_rays += shadow_rays;
    finish(p, p.alive & ~survivors, bits(cut), per_unit, pixels);
    p.alive = survivors;
  }
}

}  // namespace tyndall
