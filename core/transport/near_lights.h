#pragma once
#include "core/transport/event.h"

/// Direct light in media close to a small light. For each ray that crosses media, a pair of a medium and a light near
/// it is drawn, a place on the ray is sampled by the angle at which the light sees it (see Equiangular), and there the
/// light is sampled.
namespace tyndall {

/// What fly_by_angle() samples for each lane: a pair of a medium and a light near it, and a flight that ends in the
/// medium at a distance chosen for that light.
template <class F>
struct NearEvent {
  MediumEvent<F> found;  ///< without `begin` and `far`; happens where the ray crosses the medium
  IntOf<F> light;
  MediumFlight<F> flight;
};

/// Samples a place in media by angle. to_surface: distance along the ray to the next surface.
template <class F>
TYNDALL_INLINE NearEvent<F> fly_by_angle(const SceneView& s, const Paths<F>& p, MaskOf<F> lanes, F to_surface) {
  const F count = splat<F>(static_cast<float>(s.near.medium.count())), zero = F(0.0f);
  const IntOf<F> pair = to_int(min(p.sampler.next_1d(dimension::near_pair) * count, count - F(1.0f)));
  const Ray<F>& ray = p.ray;
  MediumEvent<F> found = no_event<F>();
  const IntOf<F> light = lookup<F>(s.near.light, s.near.medium.count(), pair),
                 medium = lookup<F>(s.near.medium, s.near.medium.count(), pair);
  MediumFlight<F> flight{medium, ray.origin, ray.direction, zero, F(1.0f), zero, zero};
  for (int k = 0; k < s.media.count(); ++k) {
    const MediumColumns& m = s.media[k];
    const auto mine = mask_and(lanes, equal(medium, IntOf<F>(k)));
    if (!any(mine)) continue;
    const Interval<F> inside = medium_interval(m, ray.origin, ray.direction, ray.from);
    const F begin = max(inside.near, zero), end = min(inside.far, to_surface);
    const auto here = mask_and(mask_and(mine, inside.hit), less(begin, end));
    found.happens = mask_or(found.happens, here);
    flight.begin = select(here, begin, flight.begin), flight.end = select(here, end, flight.end);
    found.density = select(here, splat<F>(m.density), found.density);
    found.g = select(here, splat<F>(m.g), found.g);
    found.albedo = select(here, splat<F>(m.albedo), found.albedo);
    found.texture = select(here, IntOf<F>(m.texture), found.texture);
    found.from = select(here, IntOf<F>(4 * m.first + static_cast<std::int32_t>(Side::within)), found.from);
  }
  flight.distance = sample(distances_past(s.lights, light, flight), p.sampler.next_1d(dimension::near_distance));
  flight.pdf = found.density * pass_media(s, ray, flight.distance, found.happens);
  found.point = point_at(ray.origin, flight.distance, ray.direction);
  return {found, light, flight};
}

/// Radiance that lights send to the places sampled by angle. It is not inlined, because it holds nearly all of the code
/// of direct_light(): a second copy would take seconds to compile in each kernel. Its arguments are copies, so that the
/// path loop can keep its own values in registers.
template <class F>
[[gnu::noinline]] static Vec3<F> light_by_angle(const auto& s, Ray<F> ray, Vec3<F> throughput, Sampler<F> sampler,
                                                MaskOf<F> lanes, F to_surface, std::uint32_t& shadow_rays) {
  Paths<F> p{};
  p.ray = ray, p.throughput = throughput, p.sampler = sampler;
  const NearEvent<F> near = fly_by_angle(s, p, lanes, to_surface);
  if (!any(near.found.happens)) return zero3<F>();
  Event<F> e{};
  e.surface = less(F(1.0f), F(0.0f)), e.medium = near.found.happens;
  meet_media(s, near.found, e);
  const LightQuery<F> query{{near.light, beside_sky(s, e.point, choice_probability(s.lights, e.point, near.light))},
                            p.sampler.next_2d(dimension::near_point),
                            near.flight,
                            true};
  return direct_light(s, p, e, e.medium, query, shadow_rays);
}

/// Adds to the radiance of `p` the light of the places sampled by angle, and sets p.flight to the free flight that
/// ended at the event `found`, so that its pdf can be weighed against that of a flight ended by angle. throughput: at
/// the start of the ray, because the weights include what media absorb up to such a place. lengths: of the ray, to its
/// event (x) and to the next surface (y).
template <class F>
TYNDALL_INLINE void add_near_lights(const auto& s, Paths<F>& p, Vec3<F> throughput, const MediumEvent<F>& found,
                                    MaskOf<F> active, Pair<F> lengths, std::uint32_t& shadow_rays) {
  const F pdf = found.density * pass_media(s, p.ray, lengths.x, found.happens);
  p.flight = {found.medium, p.ray.origin, p.ray.direction, found.begin, min(found.far, lengths.y), lengths.x, pdf};
  const auto lanes = mask_and(active, less(p.depth, IntOf<F>(s.max_depth)));
  p.radiance = p.radiance + light_by_angle(shared_view(s), p.ray, throughput, p.sampler, lanes, lengths.y, shadow_rays);
}

}  // namespace tyndall
