#pragma once
#include "core/kernel/chain_trail.h"
#include "core/kernel/flight.h"
#include "core/kernel/glints.h"
#include "core/kernel/lights.h"
#include "core/kernel/shade.h"

/// What happens to a group of paths where they meet something: they add the light of a lamp that they have found, ask a
/// lamp for light by a shadow ray, and scatter into new directions.
namespace tyndall {

/// Everything a group of paths carries from event to event.
template <class F>
struct Paths {
  Ray<F> ray;
  Vec3<F> throughput, radiance;
  Dice<F> dice;
  IntOf<F> depth;  ///< scattering events so far
  F density;       ///< of the ray's direction, per steradian; one_direction: light sampling could not have chosen it
  FogFlight<F> flight;      ///< the flight to where the ray starts; only in scenes with lamps in fog
  ChainTrail<F> trail;      ///< what it met since it scattered last; only in scenes with chains
  IntOf<F> slot;            ///< 2 · pixel within the tile + half; place in SharedPaths in kernels that share
  F weight;                 ///< of the sample, see glints.h; only in scenes with chains
  IntOf<F> way;             ///< what is left of its way to a glint, or 0: see glint_way(); only in scenes with chains
  std::uint32_t alive = 0;  ///< bit i: lane i follows a path
  std::uint32_t straight = 0;  ///< bit i: it has met nothing yet but smooth glass and mirrors; 0 without lamps
  /// Bit i: its first, its second vertex is one of those that are shared (share.h). 0 in kernels that do not share.
  std::uint32_t first = 0, second = 0;
};

/// The places where a group of lanes is about to scatter: points of surfaces and points within media.
template <class F>
struct Event {
  MaskOf<F> surface, medium;  ///< which lanes are at a surface, which in a medium; never both
  Vec3<F> point;
  Vec3<F> colour;  ///< albedo
  IntOf<F> from;   ///< Ray::from of rays that leave to the side from which the ray came, or that start in the medium
  Incident<F> incident;  ///< only set if any lane is at a surface
  SurfacePoint<F> at;    ///< likewise
  IntOf<F> kind;         ///< of the material: its place in MaterialKinds
  F asks;                ///< probability of asking for a chain; only in scenes with chains
  F g;                   ///< of the medium
};

/// An event of which no more is known than the ray that led to it. What describes surfaces is left as it is: to clear
/// it in every step would take up to a tenth of the time in fog.
template <class F>
TYNDALL_INLINE Event<F> event_on(const Ray<F>& ray, const Dice<F>& dice) {
  const auto none = less(F(1.0f), F(0.0f));
  Event<F> e;
  e.surface = none, e.medium = none;
  e.point = ray.origin, e.colour = zero3<F>(), e.from = ray.from;
  e.incident.schlick = false, e.incident.dice = dice;
  e.kind = IntOf<F>(0), e.asks = F(1.0f), e.g = F(0.0f);
  return e;
}

/// Whether light that arrives after an event counts as seen by way of a mirror: the event sends it into one direction,
/// or into a lobe with a density above 8 per steradian, about 20 degrees wide.
template <class F>
TYNDALL_INLINE MaskOf<F> is_narrow(F density) {
  return mask_not(mask_and(less(F(0.0f), density), less(density, F(8.0f))));
}

/// Density per steradian with which a medium scatters from one direction into another.
template <class F>
TYNDALL_INLINE F phase_density(const auto& s, F g, Vec3<F> before, Vec3<F> after) {
  if (!s.needs.phase_functions) return F(static_cast<float>(0.25 / pi));  // what the formula gives for g = 0
  return henyey_greenstein_density(g, dot(before, after));
}

/// Which light an event asks for, and how the event was found.
template <class F>
struct LightAsked {
  LightChoice<F> choice;  ///< with the probability with which choose_light() takes this light there
  Pair<F> u;              ///< random numbers for the point of the light
  FogFlight<F> flight;    ///< the flight that led to the event
  bool by_angle;          ///< that flight was ended by angle for this very light
};

/// Light that arrives at an event straight from a lamp, estimated by one shadow ray to one light. With integrator mis
/// it is weighed by the power heuristic (E. Veach, Robust Monte Carlo Methods for Light Transport Simulation, 1997,
/// section 9.2) against two other ways to sample the same path. All densities are divided by that of free flight and
/// light sampling; let r be that of scattering towards the light, q that of ending the flight by angle. Then the
/// weights are 1 / (1 + r² + q²) for light sampling, r² / (1 + r² + q²) for scattering, q² / (1 + r² + q²) for flights
/// by angle.
template <class F>
TYNDALL_INLINE Vec3<F> direct_light(const auto& s, const Paths<F>& p, const Event<F>& e, MaskOf<F> lanes,
                                    const LightAsked<F>& asked, std::uint32_t& shadow_rays) {
  const LightChoice<F>& choice = asked.choice;
  const LightSample<F> sample = sample_light(s.lights, choice.light, e.point, p.ray.time, asked.u);
  F scattered = F(0.0f);
  if (any(e.surface)) scattered = density_any(s, e.at.material, e.kind, e.surface, e.incident, sample.direction);
  if (s.has_media() && any(e.medium))
    scattered = select(e.medium, phase_density(s, e.g, p.ray.direction, sample.direction), scattered);
  const F chosen = sample.density * choice.probability;
  const auto useful = mask_and(lanes, mask_and(less(F(0.0f), scattered), less(F(0.0f), chosen)));
  if (!any(useful)) return zero3<F>();
  shadow_rays += static_cast<std::uint32_t>(__builtin_popcount(bits(useful)));
  const Ray<F> ray{e.point, sample.direction, p.ray.time, e.from};
  const IntOf<F> element = s.lights.count == 1 ? IntOf<F>(s.lights.element[0])
                                               : lookup_int<F>(s.lights.element, s.lights.count, choice.light);
  const auto arrives = mask_and_not(useful, blocked(s, ray, sample.distance, element, useful));
  if (!any(arrives)) return zero3<F>();
  const F ratio = scattered / select(useful, chosen, F(1.0f));
  F weight = ratio;
  if (s.integrator == Integrator::mis) {
    const F odds = s.has_lamps_in_fog() ? by_angle_odds(s, asked.flight, choice.light, choice.probability) : F(0.0f);
    weight = weight / mul_add(ratio, ratio, F(1.0f) + odds);
    if (asked.by_angle) weight = weight * sqrt(odds);
  }
  if (s.has_media()) weight = weight * pass_media(s, ray, sample.distance, arrives);
  const Vec3<F> radiance = light_radiance(s, element, along(e.point, sample.distance, sample.direction), arrives);
  return select(arrives, weight * (p.throughput * e.colour * radiance), zero3<F>());
}

/// Weight of the light of a lamp that a ray met by chance: 1 where no shadow ray could have asked for it.
template <class F>
TYNDALL_INLINE F found_light_weight(const auto& s, const Paths<F>& p, IntOf<F> element, F distance, MaskOf<F> lit) {
  const auto could = mask_and(lit, less(F(0.0f), p.density));
  if (!s.light_sampling || !any(could)) return F(1.0f);
  if (s.integrator != Integrator::mis) return select(could, F(0.0f), F(1.0f));
  const IntOf<F> light = lookup_int<F>(s.light_of, s.element_count, element);
  const IntOf<F> safe = select(less(light, IntOf<F>(0)), IntOf<F>(0), light);
  const F chosen = light_density(s.lights, safe, p.ray.origin, p.ray.time, p.ray.direction, distance);
  const F ratio = p.density / max(chosen, F(1e-30f));
  F others = F(1.0f);
  if (s.has_lamps_in_fog())
    others = others + by_angle_odds(s, p.flight, safe, choice_probability(s.lights, p.ray.origin, safe));
  return select(could, F(1.0f) - others / mul_add(ratio, ratio, others), F(1.0f));
}

/// Adds the radiance of the lamp in lanes that have met one, and describes the event in the others.
template <class F>
TYNDALL_INLINE void meet_surfaces(const auto& s, Paths<F>& p, const Hit<F>& hit, Vec3<F> unit, Event<F>& e) {
  e.at = surface_at(s, p.ray, hit.t, hit.element);
  e.kind = lookup_int<F>(s.kind, s.material_count, e.at.material);
  const Vec3<F> colour = surface_colour(s, e.at, e.surface);
  const auto lit = mask_and(e.surface, equal(e.kind, IntOf<F>(kind_of<Light<double>>())));
  if (any(lit)) {
    F weight = found_light_weight(s, p, e.at.element, hit.t, lit);
    if (s.has_chains()) {
      const IntOf<F> light = lookup_int<F>(s.light_of, s.element_count, e.at.element);
      weight = weight * found_by_chance_weight(s, p.trail, p.ray, light, e.at.point, lit);
    }
    p.radiance = select(lit, p.radiance + weight * (p.throughput * colour), p.radiance);
  }
  e.surface = mask_and_not(e.surface, lit);
  const F towards = dot(p.ray.direction, e.at.normal);
  const auto along_normal = less(F(0.0f), towards);
  const Vec3<F> facing = select(along_normal, -e.at.normal, e.at.normal);
  e.incident = {p.ray.direction, e.at.normal, facing,    min(abs(towards), F(1.0f)),
                along_normal,    unit,        s.schlick, p.dice};
  const IntOf<F> one = IntOf<F>(1), zero = IntOf<F>(0);
  const IntOf<F> inside = select(along_normal, select(e.at.inverted, zero, one), select(e.at.inverted, one, zero));
  e.point = select(e.surface, e.at.point, e.point);
  e.colour = select(e.surface, colour, e.colour);
  e.from = select(e.surface, e.at.element * IntOf<F>(4) + inside, e.from);
}

/// Draws where the paths scatter in media (see fly_through_media()), and takes away what smoke absorbs until there.
template <class F>
TYNDALL_INLINE void cross_media(const auto& s, Paths<F>& p, MaskOf<F> active, F& nearest, MediumEvent<F>& event) {
  fly_through_media(s, p.ray, p.dice, active, nearest, event);
  p.throughput = kept_by_smoke(s, p.ray, p.dice, nearest, active) * p.throughput;
}

/// Describes the event in lanes that scatter in a medium.
template <class F>
TYNDALL_INLINE void meet_media(const auto& s, const MediumEvent<F>& found, Event<F>& e) {
  Vec3<F> albedo = found.albedo;
  if (s.has_textures()) albedo = textured<F>(s, albedo, found.texture, e.medium, found.point, nullptr);
  e.point = select(e.medium, found.point, e.point);
  e.colour = select(e.medium, albedo, e.colour);
  e.from = select(e.medium, found.from, e.from);
  e.g = found.g;
}

/// Lanes on the way to a glint: they were drawn in its box, and have met nothing yet but smooth glass and mirrors.
template <class F>
TYNDALL_INLINE MaskOf<F> seeks_glint(const Paths<F>& p) {
  return mask_and(less(IntOf<F>(0), p.way), mask_from_bits<F>(p.straight));
}

/// Steers the lanes that look for a glint through its glass: into it at first and out of it at last, and each order of
/// the events between is as likely. Returns the weight of each lane: the share of the light that goes its way over the
/// probability of taking it. Although it seldom runs it is no call, which would keep the paths and their events in
/// memory.
template <class F>
TYNDALL_INLINE F seek_glint(const SceneView& s, Paths<F>& p, const Event<F>& e, MaskOf<F> lanes, Scattered<F>& out) {
  using I = IntOf<F>;
  const F zero = F(0.0f), one = F(1.0f);
  const Boundary<F> b = boundary_at(load_material<Dielectric<F>, F>(s, e.at.material), e.incident);
  const I reflections = as_int(shift_right<4>(as_uint(p.way))) & I(15), crossings = p.way & I(15);
  const auto by_choice = mask_and(less(zero, b.reflected), less(b.reflected, one));
  const auto steered = mask_and(by_choice, less(I(0), reflections));
  const auto enters = mask_and(equal(p.depth, I(0)), less(I(0), crossings));
  const F between = max(from_int<F>(crossings) - one, zero), left = max(from_int<F>(reflections) + between, one);
  const F wanted = select(enters, zero, from_int<F>(reflections) / left);
  const F probability = mul_add(select(steered, F(glint_steering), zero), wanted - b.reflected, b.reflected);
  const auto reflects = less(e.incident.dice.one(dimension::lobe), probability);
  const Scattered<F> scattered = leave_boundary(b, e.incident, reflects);
  out.direction = select(lanes, scattered.direction, out.direction);
  out.transmitted = mask_or(mask_and(lanes, scattered.transmitted), mask_and_not(out.transmitted, lanes));
  const I reflected = select(less(I(0), reflections), p.way - I(16), p.way);
  const I crossed = select(less(I(0), crossings), p.way - I(1), p.way);
  p.way = select(lanes, select(reflects, reflected, crossed), p.way);
  const F weight = select(reflects, b.reflected / probability, (one - b.reflected) / (one - probability));
  return select(mask_and(lanes, steered), weight, one);
}

/// Gives the paths new directions. Returns which lanes go on; the others were absorbed. weight: by which each lane's
/// throughput is to be multiplied; it is 1 unless it looks for a glint.
template <class F>
TYNDALL_INLINE MaskOf<F> scatter(const auto& s, Paths<F>& p, const Event<F>& e, Vec3<F> unit, Pair<F> u, F& weight) {
  const Vec3<F> before = p.ray.direction;
  const Ray<F> came = p.ray;
  MaskOf<F> transmitted = less(F(1.0f), F(0.0f));
  MaskOf<F> goes_on = e.medium;
  weight = F(1.0f);
  p.ray.origin = e.point;
  p.ray.from = e.from;
  if (any(e.surface)) {
    Scattered<F> out = scatter_any(s, e.at.material, e.kind, e.surface, e.incident);
    if (s.has_chains() && s.glint_count > 0) {
      const auto glass = mask_and(e.surface, equal(e.kind, IntOf<F>(kind_of<Dielectric<double>>())));
      const auto seeks = mask_and(glass, seeks_glint(p));
      if (any(seeks)) weight = seek_glint(s, p, e, seeks, out);
    }
    p.ray.direction = select(e.surface, out.direction, p.ray.direction);
    p.density = select(e.surface, out.density, p.density);
    transmitted = out.transmitted;
    // Through the surface: on its other side, inside for outside.
    const auto through = mask_and(e.surface, out.transmitted);
    const IntOf<F> side = e.from & IntOf<F>(1);
    p.ray.from = select(through, e.from + IntOf<F>(1) - (side + side), p.ray.from);
    goes_on = mask_or(goes_on, mask_and_not(e.surface, out.absorbed));
  }
  if (s.has_media() && any(e.medium)) {
    Vec3<F> direction = unit;
    if (s.needs.phase_functions) direction = scatter_in_medium(e.g, before, unit, u);
    p.ray.direction = select(e.medium, direction, p.ray.direction);
    p.density = select(e.medium, phase_density(s, e.g, before, direction), p.density);
  }
  if (s.has_chains()) follow_chain(s, p.trail, came, e, mask_not(transmitted), p.density);
  return goes_on;
}

/// Russian roulette: ends paths at random, the sooner the less they carry, and lets the survivors carry more by as much
/// as the ended ones would have. J. Arvo, D. Kirk, Particle Transport and Image Synthesis, SIGGRAPH 1990.
/// Only paths whose throughput is below `least_carried` are at risk.
template <class F>
TYNDALL_INLINE MaskOf<F> roulette(Paths<F>& p, MaskOf<F> lanes) {
  const F survival = F(1 / least_carried) * max_component(p.throughput);
  const auto at_risk = mask_and(lanes, less(survival, F(1.0f)));
  if (!any(at_risk)) return lanes;
  const auto ended = mask_and_not(at_risk, less(p.dice.one(dimension::roulette), survival));
  const F scale = F(1.0f) / select(at_risk, max(survival, F(1e-37f)), F(1.0f));
  p.throughput = select(at_risk, scale * p.throughput, p.throughput);
  return mask_and_not(lanes, ended);
}

/// Roulette that does not ask the lanes in `spared`: a path never ends before its second vertex can be shared, nor on
/// the way to a glint.
template <class F>
TYNDALL_INLINE MaskOf<F> roulette_but(Paths<F>& p, MaskOf<F> lanes, MaskOf<F> spared) {
  return mask_or(roulette(p, mask_and_not(lanes, spared)), mask_and(lanes, spared));
}

}  // namespace tyndall
