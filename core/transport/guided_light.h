#pragma once
#include "core/guide/guide_trail.h"
#include "core/specular/request.h"
#include "core/transport/event.h"

/// Light that events at diffuse surfaces receive along guided paths: see core/guide.
namespace tyndall {

/// A guided path that is followed: its events are those of its sequence. Fuzzy metal scatters at random. What a path
/// remembers for events at diffuse surfaces is left uninitialised: to clear it would take 2 % of the time.
template <class F>
struct GuidedPath {
  Paths<F> path;            ///< its radiance is what the path has found
  OrderedEvents<F> left;    ///< events to come, the next one in the lowest bits
  F reflectance = F(1.0f);  ///< product of what glass sends along the path
  std::uint32_t rays = 0, shadow_rays = 0;
};

/// Sends a guided path on from the surface of its next event. Returns the lanes that go on.
template <class F>
TYNDALL_INLINE MaskOf<F> scatter_guided(const auto& s, GuidedPath<F>& g, const Event<F>& e, MaskOf<F> lanes) {
  Paths<F>& p = g.path;
  const auto glossy = mask_and(lanes, has_trait<&BsdfTraits::glossy>(s, e.kind)), glass = mask_and_not(lanes, glossy);
  const auto reflects = g.left.lowest_reflects();
  p.throughput = select(lanes, p.throughput * e.colour, p.throughput);
  p.ray.origin = select(lanes, e.point, p.ray.origin), p.ray.from = select(lanes, e.from, p.ray.from);
  auto goes_on = lanes;
  if (any(glossy)) {
    const BsdfSample<F> out = sample_any(s, e.at.material, e.kind, glossy, e.incident);
    p.ray.direction = select(glossy, out.direction, p.ray.direction), p.pdf = select(glossy, out.pdf, p.pdf);
    p.throughput = select(glossy, out.weight * p.throughput, p.throughput);
    goes_on = mask_and_not(goes_on, mask_and(glossy, out.flags.absorbed));
  }
  if (any(glass)) {
    const Boundary<F> b = boundary_any(s, e.at.material, e.incident);
    const BsdfSample<F> out = leave_boundary(b, e.incident, reflects);
    const F fraction = select(reflects, b.reflected, F(1.0f) - b.reflected);
    p.ray.direction = select(glass, out.direction, p.ray.direction), p.pdf = select(glass, F(one_direction), p.pdf);
    p.ray.from = select(mask_and_not(glass, reflects), through_surface<F>(e.from), p.ray.from);
    p.throughput = select(glass, fraction * p.throughput, p.throughput);
    g.reflectance = select(glass, fraction * g.reflectance, g.reflectance);
    goes_on = mask_and_not(goes_on, mask_and_not(glass, less(F(0.0f), fraction)));
  }
  return goes_on;
}

/// Takes guided paths to their next surface and on. Returns the lanes that go on.
template <class F>
TYNDALL_INLINE MaskOf<F> step_guided(const auto& s, GuidedPath<F>& g, MaskOf<F> active) {
  using I = IntOf<F>;
  Paths<F>& p = g.path;
  g.rays += static_cast<std::uint32_t>(__builtin_popcount(bits(active)));
  const Hit<F> hit = call_closest(shared_view(s), p.ray, active);
  active = mask_and(active, less_equal(I(0), hit.element));
  if (!any(active)) return active;
  if (s.has_media()) {
    const F passes = pass_media(s, p.ray, hit.t, active);
    p.throughput = select(active, passes * p.throughput, p.throughput);
  }
  Event<F> e = event_on(p.ray, p.sampler);
  e.surface = active;
  meet_surfaces(s, p.ray, hit, e);
  const auto ended = mask_and_not(active, g.left.has_events());
  const auto lit = mask_and(ended, has_trait<&BsdfTraits::emits>(s, e.kind));
  if (any(lit)) {
    const F weight = found_light_weight(s, p, e.at.element, hit.t, lit);
    p.radiance = select(lit, p.radiance + weight * (p.throughput * e.colour), p.radiance);
  }
  const I thing = lookup<F>(s.guide.thing_of, s.elements.count(), e.at.element);
  active = mask_and(active, mask_and(less_equal(I(0), thing), equal(g.left.lowest_thing(), thing)));
  if (!any(active)) return active;
  e.surface = active;
  describe_incidence(s, p, on_sphere(p.sampler.next_2d(dimension::direction)), e);
  // Where a path meets its last surface, and that is metal, a light is sampled.
  const auto last = mask_and_not(active, g.left.without_lowest().has_events());
  const auto at_metal = mask_and(last, has_trait<&BsdfTraits::glossy>(s, e.kind));
  if (any(at_metal)) {
    const LightQuery<F> query{choose_light(s.lights, e.point, p.sampler.next_1d(dimension::light_choice)),
                              p.sampler.next_2d(dimension::light_point), p.flight, false};
    p.radiance = p.radiance + direct_light(s, p, e, at_metal, query, g.shadow_rays);
  }
  active = scatter_guided(s, g, e, active);
  g.left = g.left.without_lowest();
  p.sampler.next_event();
  return active;
}

/// Radiance that reaches the requests' points along guided paths, times their throughput. Adds their rays to
/// `rays` and to `shadow_rays`.
template <class F>
[[gnu::noinline]] static Vec3<F> guided_light(const auto& s, const SpecularRequest<F>& q, MaskOf<F> lanes,
                                              std::uint32_t& rays, std::uint32_t& shadow_rays) {
  using I = IntOf<F>;
  const Guide& guide = s.guide;
  const GuidedSequence<F> sequence =
      draw_guided_sequence(guide, q.point, q.sampler.independent_1d(dimension::guided_events), lanes);
  const GuidedDirections<F> directions = guided_directions(guide, sequence, q.point);
  MaskOf<F> active = lanes;
  GuidedPath<F> g;
  g.path.ray = {q.point,
                draw_guided_direction(directions, q.sampler.independent_1d(dimension::guided_strategy),
                                      q.sampler.next_2d(dimension::guided_direction), active),
                q.time, q.from};
  const Vec3<F> direction = g.path.ray.direction;
  const auto its = record_in<F>(guide.sequences, select(active, sequence.index, I(0)));
  g.left = {its(&GuideSequence::next_low), its(&GuideSequence::next_high)};
  const I depth = q.depth + its(&GuideSequence::count);
  const F scattered = scattered_pdf(s, q, direction), pdf = guided_pdf(directions, direction);
  const auto useful = mask_and(less(F(0.0f), scattered), less(F(0.0f), pdf));
  active = mask_and(mask_and(lanes, active), mask_and(useful, less(depth, I(s.max_depth))));
  const auto followed = active;
  g.path.throughput = q.throughput, g.path.radiance = zero3<F>(), g.path.pdf = F(one_direction);
  g.path.sampler = q.sampler;
  g.path.sampler.event = g.path.sampler.event + UintOf<F>(dimension::guided_path * golden_ratio);
  if (s.has_media()) g.path.flight = MediumFlight<F>{}, g.path.flight.medium = I(-1);
  while (any(active)) active = step_guided(s, g, active);
  rays += g.rays, shadow_rays += g.shadow_rays;
  const F safe = select(followed, pdf, F(1.0f)), ratio = scattered * g.reflectance / safe;
  const F weight = scattered / (safe * mul_add(ratio, ratio, F(1.0f)));
  return select(followed, weight * g.path.radiance, zero3<F>());
}

/// What a path's trail remembers of an event: it starts anew where the path scatters at a diffuse surface, and ends in
/// media. transmitted: lanes that pass a surface.
template <class F>
TYNDALL_INLINE void extend_guide_trail(const auto& s, Paths<F>& p, const Event<F>& e, MaskOf<F> transmitted) {
  GuideTrail<F>& trail = p.guide;
  const auto diffuse = mask_and(e.surface, has_trait<&BsdfTraits::diffuse>(s, e.kind));
  const auto met = mask_and_not(mask_and(e.surface, trail.events.is_known()), diffuse);
  if (any(met)) {
    trail.events = select(met, events_with(s, trail, e.at.element, mask_not(transmitted)), trail.events);
    const auto glass = mask_and(met, has_trait<&BsdfTraits::smooth_boundary>(s, e.kind));
    if (any(glass)) {
      const F reflected = boundary_any(s, e.at.material, e.incident).reflected;
      const F fraction = select(transmitted, F(1.0f) - reflected, reflected);
      trail.pdf = select(glass, fraction * trail.pdf, trail.pdf);
    }
  }
  trail.start = select(diffuse, e.point, trail.start), trail.pdf = select(diffuse, p.pdf, trail.pdf);
  trail.direction = select(diffuse, p.ray.direction, trail.direction);
  using Events = OrderedEvents<F>;
  trail.events = select(diffuse, Events::none(), select(e.medium, Events::unknown(), trail.events));
}

/// Weighs direct light at metal, which guided paths find as well.
template <class F>
TYNDALL_INLINE Vec3<F> weigh_beside_guide(const auto& s, const Paths<F>& p, const Event<F>& e, Vec3<F> light) {
  const auto glossy = mask_and(e.surface, has_trait<&BsdfTraits::glossy>(s, e.kind));
  const auto both = mask_and(mask_and(glossy, p.guide.events.is_known()), less(F(0.0f), max_component(light)));
  if (!any(both)) return light;
  const OrderedEvents<F> events = events_with(s, p.guide, e.at.element, less(F(0.0f), F(1.0f)));
  return select(both, mis_weight_beside_guide(s, p.guide, events, both) * light, light);
}

}  // namespace tyndall
