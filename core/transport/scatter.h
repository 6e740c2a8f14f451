#pragma once
#include "core/transport/guided_light.h"

/// How paths continue from an event: by the BSDF or the phase function, and by Russian roulette.
namespace tyndall {

/// Whether light that arrives after an event counts as seen in a mirror: the event sends the path into one direction,
/// or into a lobe of a pdf above 8 per steradian, about 20 degrees wide.
template <class F>
TYNDALL_INLINE MaskOf<F> is_narrow_lobe(F pdf) {
  return mask_not(mask_and(less(F(0.0f), pdf), less(pdf, F(8.0f))));
}

/// Steers lanes with a route to a subpixel light through glass: the first event enters, the last one leaves, and each
/// order of the events between is equally likely. Returns the weight of each lane: the probability of its event at
/// unsteered glass over that with steering. It seldom runs, but is inlined: a call would keep the paths and their
/// events in memory.
template <class F>
TYNDALL_INLINE F seek_subpixel_light(const auto& s, Paths<F>& p, const Event<F>& e, MaskOf<F> lanes,
                                     BsdfSample<F>& out) {
  using I = IntOf<F>;
  const F zero = F(0.0f), one = F(1.0f);
  const Boundary<F> b = boundary_any(s, e.at.material, e.incident);
  const I reflections = p.route.reflections(), crossings = p.route.crossings();
  const auto by_choice = mask_and(less(zero, b.reflected), less(b.reflected, one));
  const auto steered = mask_and(by_choice, less(I(0), reflections));
  const auto enters = mask_and(equal(p.depth, I(0)), less(I(0), crossings));
  const F between = max(from_int<F>(crossings) - one, zero), left = max(from_int<F>(reflections) + between, one);
  const F wanted = select(enters, zero, from_int<F>(reflections) / left);
  const F probability = mul_add(select(steered, F(subpixel_light_steering), zero), wanted - b.reflected, b.reflected);
  const auto reflects = less(e.incident.sampler.next_1d(dimension::lobe), probability);
  const BsdfSample<F> steered_out = leave_boundary(b, e.incident, reflects);
  out.direction = select(lanes, steered_out.direction, out.direction);
  MaskOf<F>& transmitted = out.flags.transmitted;
  transmitted = mask_or(mask_and(lanes, steered_out.flags.transmitted), mask_and_not(transmitted, lanes));
  p.route.count(lanes, reflects);
  const F weight = select(reflects, b.reflected / probability, (one - b.reflected) / (one - probability));
  return select(mask_and(lanes, steered), weight, one);
}

/// Samples new directions. Returns the lanes that go on; the other lanes were absorbed. weight: factor on each lane's
/// throughput; 1 unless the lane is steered to a subpixel light or its material has weighted samples.
template <class F>
TYNDALL_INLINE MaskOf<F> scatter(const auto& s, Paths<F>& p, const Event<F>& e, Vec3<F> unit_vector, Pair<F> u,
                                 F& weight) {
  const Vec3<F> before = p.ray.direction;
  const Ray<F> came = p.ray;
  MaskOf<F> transmitted = less(F(1.0f), F(0.0f));
  MaskOf<F> goes_on = e.medium;
  weight = F(1.0f);
  p.ray.origin = e.point;
  p.ray.from = e.from;
  if (any(e.surface)) {
    BsdfSample<F> out = sample_any(s, e.at.material, e.kind, e.surface, e.incident);
    weight = out.weight;
    if (s.has_specular_paths() && s.subpixel_lights.count() > 0) {
      const auto glass = mask_and(e.surface, has_trait<&BsdfTraits::smooth_boundary>(s, e.kind));
      const auto seeks = mask_and(glass, seeks_subpixel_light(p));
      if (any(seeks)) weight = weight * seek_subpixel_light(s, p, e, seeks, out);
    }
    p.ray.direction = select(e.surface, out.direction, p.ray.direction);
    p.pdf = select(e.surface, out.pdf, p.pdf);
    transmitted = out.flags.transmitted;
    p.ray.from = select(mask_and(e.surface, transmitted), through_surface<F>(e.from), p.ray.from);
    goes_on = mask_or(goes_on, mask_and_not(e.surface, out.flags.absorbed));
  }
  if (s.has_media() && any(e.medium)) {
    Vec3<F> direction = unit_vector;
    if (s.features.phase_functions) direction = scatter_in_medium(e.g, before, unit_vector, u);
    p.ray.direction = select(e.medium, direction, p.ray.direction);
    p.pdf = select(e.medium, phase_pdf(s, e.g, before, direction), p.pdf);
  }
  if (s.has_specular_paths()) {
    const auto spreads = accepts_specular_paths(s, e);
    extend_trail(s, p.trail, came, mask_and_not(e.surface, spreads), e.at.element, mask_not(transmitted));
    restart_trail(p.trail, spreads, e.point, p.pdf, e.connect_probability);
  }
  if (s.has_guide()) extend_guide_trail(s, p, e, transmitted);
  return goes_on;
}

/// Russian roulette: ends paths at random, the more likely the less they carry, and divides the throughput of the
/// survivors by the probability of survival. Paths in the lanes `exempt`, and those with a throughput of at least
/// `min_carried`, are never ended. J. Arvo, D. Kirk, Particle Transport and Image Synthesis, SIGGRAPH 1990.
template <class F>
TYNDALL_INLINE MaskOf<F> roulette(Paths<F>& p, MaskOf<F> lanes, MaskOf<F> exempt) {
  const F survival = F(1 / min_carried) * max_component(p.throughput);
  const auto at_risk = mask_and_not(mask_and(lanes, less(survival, F(1.0f))), exempt);
  if (!any(at_risk)) return lanes;
  const auto ended = mask_and_not(at_risk, less(p.sampler.next_1d(dimension::roulette), survival));
  const F scale = F(1.0f) / select(at_risk, max(survival, F(1e-37f)), F(1.0f));
  p.throughput = select(at_risk, scale * p.throughput, p.throughput);
  return mask_and_not(lanes, ended);
}

}  // namespace tyndall
