#pragma once
#include "core/kernel/camera.h"
#include "core/kernel/flight.h"
#include "core/kernel/shade.h"

/// The path loop: a group of lanes, each following its own path; a lane whose path has ended takes the next camera ray.
namespace tyndall {

/// Everything a group of paths carries from event to event.
template <class F>
struct Paths {
  Ray<F> ray;
  Vec3<F> throughput, radiance;
  Dice<F> dice;
  IntOf<F> depth;  ///< scattering events so far
  std::int32_t slot[lanes_of<F>];
  std::uint32_t half[lanes_of<F>];
  std::uint32_t alive = 0;  ///< a bit a lane
};

/// Gives free lanes a camera ray each, as long as there are samples.
template <class F>
TYNDALL_INLINE void take_samples(Paths<F>& p, CameraQueue<F>& queue, UnitSamples& samples, const SceneView& s, const Unit& unit) {
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
    p.ray.direction = {take(queue.dx, p.ray.direction.x), take(queue.dy, p.ray.direction.y), take(queue.dz, p.ray.direction.z)};
    p.ray.time = take(queue.time, p.ray.time);
    p.ray.from = select(m, IntOf<F>(from_nowhere), p.ray.from);
    p.dice.low = select(m, as_uint(gather_int<F>(queue.low, at)), p.dice.low);
    p.dice.high = select(m, as_uint(gather_int<F>(queue.high, at)), p.dice.high);
    p.dice.event = select(m, UintOf<F>(dimension::camera_count * golden_ratio), p.dice.event);
    p.throughput = select(m, Vec3<F>{F(1.0f), F(1.0f), F(1.0f)}, p.throughput);
    p.radiance = select(m, zero3<F>(), p.radiance);
    p.depth = select(m, IntOf<F>(0), p.depth);
    p.alive |= fresh;
  }
}

/// What a group does at its next event: where it goes on, and which lanes stop.
template <class F>
struct Next {
  Vec3<F> origin, direction, colour;
  IntOf<F> from;
  MaskOf<F> goes_on;
};

template <class F>
TYNDALL_INLINE void scatter_on_surfaces(const SceneView& s, Paths<F>& p, const Hit<F>& hit, MaskOf<F> lanes,
                                        Vec3<F> unit, Next<F>& next) {
  const SurfacePoint<F> at = surface_at(s, p.ray, hit.t, hit.element);
  const IntOf<F> kind = gather_int<F>(s.kind, at.material);
  const Vec3<F> colour = surface_colour(s, at, lanes);
  const auto lit = mask_and(lanes, equal(kind, IntOf<F>(kind_of<Light<double>>())));
  if (any(lit)) p.radiance = select(lit, p.radiance + p.throughput * colour, p.radiance);
  const auto scattering = mask_and_not(lanes, lit);
  if (!any(scattering)) return;
  const F towards = dot(p.ray.direction, at.normal);
  const auto along_normal = less(F(0.0f), towards);
  const Vec3<F> facing = select(along_normal, -at.normal, at.normal);
  const Incident<F> in{p.ray.direction, at.normal, facing, min(abs(towards), F(1.0f)), along_normal, unit, s.schlick, &p.dice};
  const Scattered<F> out = scatter_any(s, at.material, kind, scattering, in);
  // Geometrically inside before, and not through the surface; or outside before, and through it: inside after.
  const IntOf<F> one = IntOf<F>(1), zero = IntOf<F>(0);
  const IntOf<F> was_inside = select(along_normal, select(at.inverted, zero, one), select(at.inverted, one, zero));
  const IntOf<F> is_inside = select(out.transmitted, one - was_inside, was_inside);
  next.origin = select(scattering, at.point, next.origin);
  next.direction = select(scattering, out.direction, next.direction);
  next.colour = select(scattering, colour, next.colour);
  next.from = select(scattering, at.element * IntOf<F>(4) + is_inside, next.from);
  next.goes_on = mask_or(next.goes_on, mask_and_not(scattering, out.absorbed));
}

template <class F>
TYNDALL_INLINE void scatter_in_media(const SceneView& s, Paths<F>& p, const MediumEvent<F>& event, Vec3<F> unit,
                                     Pair<F> u, Next<F>& next) {
  const auto here = event.happens;
  Vec3<F> albedo = event.albedo;
  if (s.needs.textures) albedo = textured<F>(s, albedo, event.texture, here, event.point, nullptr);
  Vec3<F> direction = unit;
  if (s.needs.phase_functions) direction = scatter_in_medium(event.g, p.ray.direction, unit, u);
  next.origin = select(here, event.point, next.origin);
  next.direction = select(here, direction, next.direction);
  next.colour = select(here, albedo, next.colour);
  next.from = select(here, event.from, next.from);
  next.goes_on = mask_or(next.goes_on, here);
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

/// One step of all lanes: to the next surface, event in a medium, or out. Answers which lanes go on; `cut` are those
/// that max_depth ended.
template <class F>
TYNDALL_INLINE MaskOf<F> step(const SceneView& s, Paths<F>& p, MaskOf<F> active, MaskOf<F>& cut) {
  Hit<F> hit = closest(s, p.ray, active);
  MediumEvent<F> event{less(F(1.0f), F(0.0f)), p.ray.origin, IntOf<F>(0), zero3<F>(), IntOf<F>(-1), F(0.0f)};
  if (s.needs.media) event = fly_through_media(s, p.ray, p.dice, active, hit.t);
  const auto met = mask_and(active, mask_and_not(less_equal(IntOf<F>(0), hit.element), event.happens));
  const auto escaped = mask_and_not(mask_and_not(active, met), event.happens);
  if (s.needs.background && any(escaped))
    p.radiance = select(escaped, p.radiance + p.throughput * background_radiance(s.background, p.ray.direction), p.radiance);
  const Pair<F> u = p.dice.pair(dimension::direction);
  const Vec3<F> unit = on_sphere(u);
  Next<F> next{p.ray.origin, p.ray.direction, zero3<F>(), p.ray.from, less(F(1.0f), F(0.0f))};
  if (any(met)) scatter_on_surfaces(s, p, hit, met, unit, next);
  if (s.needs.media && any(event.happens)) scatter_in_media(s, p, event, unit, u, next);
  // A path whose state is no longer finite ends with a radiance that the film rejects and counts: `sum` is finite only
  // where all its parts are. A path that carries nothing has ended, not been cut.
  const Vec3<F> carried = p.throughput * next.colour, way = next.direction;
  const F sum = mul_add(F(0.0f), way.x + way.y + way.z, carried.x + carried.y + carried.z);
  const auto finite = less(sum, F(__builtin_inff()));
  const auto broken = mask_and_not(next.goes_on, finite);
  if (any(broken)) p.radiance = select(broken, {sum, sum, sum}, p.radiance);
  const auto useful = mask_and(mask_and(next.goes_on, finite), less(F(0.0f), sum));
  const auto deep = less_equal(IntOf<F>(s.max_depth), p.depth);
  cut = mask_and(useful, deep);
  const auto lanes = mask_and_not(useful, deep);
  p.throughput = select(lanes, carried, p.throughput);
  p.ray.origin = next.origin;
  p.ray.direction = next.direction;
  p.ray.from = next.from;
  p.depth = p.depth + IntOf<F>(1);
  const auto survivors = roulette(p, lanes);
  p.dice.next_event();
  return survivors;
}

/// Adds the samples of finished lanes to the unit's pixels.
template <class F>
TYNDALL_INLINE void finish(const Paths<F>& p, std::uint32_t finished, std::uint32_t cut, double per_unit, FilmPixel* pixels) {
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
TYNDALL_INLINE void render_unit(const SceneView& s, const Unit& unit, double film_unit, FilmPixel* pixels, UnitCounts& counts) {
  UnitSamples samples;
  list_samples(unit, samples);
  CameraQueue<F> queue;
  Paths<F> p{};
  const double per_unit = 1 / film_unit;
  for (;;) {
    take_samples(p, queue, samples, s, unit);
    if (!p.alive) return;
    counts.rays += static_cast<std::uint64_t>(__builtin_popcount(p.alive));
    MaskOf<F> cut;
    const std::uint32_t survivors = bits(step(s, p, mask_from_bits<F>(p.alive), cut)) & p.alive;
    finish(p, p.alive & ~survivors, bits(cut), per_unit, pixels);
    p.alive = survivors;
  }
}

}  // namespace tyndall
