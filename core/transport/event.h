#pragma once
#include "core/trace/lights.h"
#include "core/trace/shade.h"
#include "core/trace/sky.h"
#include "core/transport/paths.h"

/// What paths meet, points on surfaces and points in media; and direct light there: by shadow rays to lights, and by
/// paths that hit a light.
namespace tyndall {

/// The places where a group of lanes is about to scatter: points on surfaces and points in media.
template <class F>
struct Event {
  MaskOf<F> surface, medium;  ///< which lanes are at a surface, which in a medium; never both
  Vec3<F> point;
  Vec3<F> colour;  ///< albedo
  IntOf<F> from;   ///< Ray::from of rays that leave to the side from which the ray came, or that start in the medium
  Incident<F> incident;   ///< only set if any lane is at a surface
  SurfacePoint<F> at;     ///< likewise
  IntOf<F> kind;          ///< of the material: its place in SceneView::MaterialList
  F connect_probability;  ///< that a specular path is requested; only in scenes with specular paths
  F g;                    ///< asymmetry of the medium's phase function
};

/// An event of which only the ray that led to it is known. What describes surfaces is left uninitialised: to clear it
/// in every step would take up to a tenth of the time in media.
template <class F>
TYNDALL_INLINE Event<F> event_on(const Ray<F>& ray, const Sampler<F>& sampler) {
  const auto none = less(F(1.0f), F(0.0f));
  Event<F> e;
  e.surface = none, e.medium = none;
  e.point = ray.origin, e.colour = zero3<F>(), e.from = ray.from;
  e.incident.schlick = false, e.incident.sampler = sampler;
  e.kind = IntOf<F>(0), e.connect_probability = F(1.0f), e.g = F(0.0f);
  return e;
}

/// Lanes whose event is at a diffuse surface or in a medium: specular paths lead to such events only.
template <class F>
TYNDALL_INLINE MaskOf<F> accepts_specular_paths(const auto& s, const Event<F>& e) {
  return mask_or(e.medium, mask_and(e.surface, has_trait<&BsdfTraits::diffuse>(s, e.kind)));
}

/// Lanes whose event scatters light equally in all directions (but for a surface's cosine): at a diffuse surface, or in
/// a medium with g = 0.
template <class F>
TYNDALL_INLINE MaskOf<F> is_diffuse(const auto& s, const Event<F>& e) {
  const auto surface = mask_and(e.surface, has_trait<&BsdfTraits::diffuse>(s, e.kind));
  if (!s.has_media()) return surface;
  return mask_or(surface, mask_and(e.medium, equal(e.g, F(0.0f))));
}

/// The light that an event samples, and the flight that led to the event.
template <class F>
struct LightQuery {
  LightChoice<F> choice;   ///< the light, and the probability with which choose_light() takes it there
  Pair<F> u;               ///< random numbers for the point of the light
  MediumFlight<F> flight;  ///< the flight that led to the event
  bool by_angle;           ///< the flight was ended by angle, for this very light
};

/// Ray::from of a shadow ray in `direction`.
template <class F>
TYNDALL_INLINE IntOf<F> shadow_ray_from(const auto& s, const Event<F>& e, Vec3<F> direction) {
  if constexpr (samples_lights_behind<decltype(s)>) {
    const auto behind = mask_and(e.surface, less(dot(direction, e.incident.facing), F(0.0f)));
    return select(behind, through_surface<F>(e.from), e.from);
  } else {
    return e.from;
  }
}

/// Radiance of a sampled direction to a light or to the sky.
template <class F>
TYNDALL_INLINE Vec3<F> radiance_of_sample(const auto& s, IntOf<F> light, Vec3<F> point, const LightSample<F>& sample,
                                          const SkySample<F>& sky, MaskOf<F> lanes) {
  const IntOf<F> element = element_of_light<F>(s, light);
  if (!s.samples_sky()) return light_radiance(s, element, point_at(point, sample.distance, sample.direction), lanes);
  const auto far = is_sky<F>(light), near = mask_and_not(lanes, far);
  if (!any(near)) return sky.radiance;
  const Vec3<F> place = point_at(point, select(far, F(0.0f), sample.distance), sample.direction);
  return select(far, sky.radiance, light_radiance(s, select(far, IntOf<F>(0), element), place, near));
}

/// Radiance that arrives at an event straight from a light, times throughput and albedo: estimated by one shadow ray to
/// one light. With integrator mis it is weighted by the power heuristic (E. Veach, Robust Monte Carlo Methods for Light
/// Transport Simulation, 1997, section 9.2) against two other ways to sample the same path. Let r be the pdf of
/// scattering towards the light and q that of ending the flight by angle, both over the pdf of free flight and light
/// sampling. The weights are 1 / (1 + r² + q²) for light sampling, r² / (1 + r² + q²) for scattering, q² / (1 + r² +
/// q²) for flights by angle.
template <class F>
TYNDALL_INLINE Vec3<F> direct_light(const auto& s, const Paths<F>& p, const Event<F>& e, MaskOf<F> lanes,
                                    const LightQuery<F>& query, std::uint32_t& shadow_rays) {
  const LightChoice<F>& choice = query.choice;
  SkySample<F> sky;
  const LightSample<F> sample =
      sample_light_or_sky(s, choice.light, {e.point, {}, p.ray.time, {}}, p.sampler, query.u, sky);
  BsdfValue<F> scattered{F(0.0f), F(0.0f)};
  if (any(e.surface)) scattered = eval_any(s, e.at.material, e.kind, e.surface, e.incident, sample.direction);
  if (s.has_media() && any(e.medium)) {
    const F phase = phase_pdf(s, e.g, p.ray.direction, sample.direction);
    scattered = {select(e.medium, phase, scattered.value), select(e.medium, phase, scattered.pdf)};
  }
  const F chosen = sample.pdf * choice.probability;
  const IntOf<F> light = s.samples_sky() ? select(is_sky<F>(choice.light), IntOf<F>(0), choice.light) : choice.light;
  const auto useful = mask_and(lanes, mask_and(less(F(0.0f), scattered.value), less(F(0.0f), chosen)));
  if (!any(useful)) return zero3<F>();
  shadow_rays += static_cast<std::uint32_t>(__builtin_popcount(bits(useful)));
  const Ray<F> ray{e.point, sample.direction, p.ray.time, shadow_ray_from(s, e, sample.direction)};
  const IntOf<F> element = element_of_light<F>(s, choice.light);
  const auto arrives = mask_and_not(useful, blocked(s, ray, sample.distance, element, useful));
  if (!any(arrives)) return zero3<F>();
  const F safe = select(useful, chosen, F(1.0f)), ratio = scattered.pdf / safe;
  F weight = scattered.value / safe;
  if (s.integrator == Integrator::mis) {
    F odds = s.has_lights_in_media() ? by_angle_odds(s, query.flight, light, choice.probability) : F(0.0f);
    if (s.samples_sky()) odds = select(is_sky<F>(choice.light), F(0.0f), odds);
    weight = weight / mul_add(ratio, ratio, F(1.0f) + odds);
    if (query.by_angle) weight = weight * sqrt(odds);
  }
  if (s.has_media()) weight = weight * pass_media(s, ray, sample.distance, arrives);
  const Vec3<F> radiance = radiance_of_sample(s, choice.light, e.point, sample, sky, arrives);
  return select(arrives, weight * (p.throughput * e.colour * radiance), zero3<F>());
}

/// Weight of the radiance of a light that a ray hit by BSDF sampling; 1 where no shadow ray could have sampled it.
template <class F>
TYNDALL_INLINE F found_light_weight(const auto& s, const Paths<F>& p, IntOf<F> element, F distance, MaskOf<F> lit) {
  const auto could = mask_and(lit, less(F(0.0f), p.pdf));
  if (!s.light_sampling || !any(could)) return F(1.0f);
  if (s.integrator != Integrator::mis) return select(could, F(0.0f), F(1.0f));
  const IntOf<F> light = lookup_int<F>(s.light_of, s.element_count, element);
  const IntOf<F> safe = select(less(light, IntOf<F>(0)), IntOf<F>(0), light);
  const F chosen = beside_sky(s, p.ray.origin, light_pdf(s, safe, p.ray.origin, p.ray.time, p.ray.direction, distance));
  const F ratio = p.pdf / max(chosen, F(1e-30f));
  F others = F(1.0f);
  if (s.has_lights_in_media())
    others = others + by_angle_odds(s, p.flight, safe,
                                    beside_sky(s, p.ray.origin, choice_probability(s.lights, p.ray.origin, safe)));
  return select(could, F(1.0f) - others / mul_add(ratio, ratio, others), F(1.0f));
}

/// Radiance of the background in the direction of rays that have escaped, weighed against light sampling where that
/// could have drawn the direction.
template <class F>
TYNDALL_INLINE Vec3<F> found_background(const auto& s, const Paths<F>& p, MaskOf<F> escaped, auto& recorder) {
  if (!s.has_sky()) return background_radiance(s.background, p.ray.direction);
  SkySample<F> sky = sky_towards(s.sky, p.ray.direction);
  if (s.has_sun_paths()) {
    const F by_chance = mis_weight_of_sun_hit(s, p.trail, p.ray, escaped);
    recorder.on_weight_against_specular_paths(by_chance);
    sky.radiance = by_chance * sky.radiance;
  }
  const auto could = mask_and(escaped, less(F(0.0f), p.pdf));
  if (!s.samples_sky() || !any(could)) return sky.radiance;
  F weight = F(0.0f);
  if (s.integrator == Integrator::mis) {
    const F chosen = sky.pdf * sky_probability<F>(s, p.ray.origin);
    const F ratio = min(p.pdf / max(chosen, F(1e-30f)), F(1e15f)), square = ratio * ratio;
    weight = square / (F(1.0f) + square);
  }
  return select(could, weight, F(1.0f)) * sky.radiance;
}

/// Looks up what the lanes in e.surface have hit: the point, its material and its colour.
template <class F>
TYNDALL_INLINE void meet_surfaces(const auto& s, const Ray<F>& ray, const Hit<F>& hit, Event<F>& e) {
  e.at = surface_at(s, ray, hit.t, hit.element);
  e.kind = lookup_int<F>(s.kind, s.material_count, e.at.material);
  e.colour = surface_colour(s, e.at, e.surface);
}

/// Adds the radiance of the lights that lanes in e.surface have hit, and removes these lanes from e.surface: lights
/// reflect nothing.
template <class F>
TYNDALL_INLINE void add_emission(const auto& s, Paths<F>& p, const Hit<F>& hit, Event<F>& e, auto& recorder) {
  const auto lit = mask_and(e.surface, has_trait<&BsdfTraits::emits>(s, e.kind));
  if (any(lit)) {
    F weight = found_light_weight(s, p, e.at.element, hit.t, lit);
    if (s.has_specular_paths()) {
      const IntOf<F> light = lookup_int<F>(s.light_of, s.element_count, e.at.element);
      const F by_chance = mis_weight_of_bsdf_hit(s, p.trail, p.ray, light, e.at.point, lit);
      recorder.on_weight_against_specular_paths(by_chance);
      weight = weight * by_chance;
    }
    if (s.has_guide()) {
      const F beside_guide = mis_weight_beside_guide(s, p.guide, p.guide.events, lit);
      recorder.on_weight_against_specular_paths(beside_guide);
      weight = weight * beside_guide;
    }
    p.radiance = select(lit, p.radiance + weight * (p.throughput * e.colour), p.radiance);
  }
  e.surface = mask_and_not(e.surface, lit);
}

/// Sets the incident direction, normals and point of the lanes in e.surface. unit_vector: see Incident.
template <class F>
TYNDALL_INLINE void describe_incidence(const auto& s, const Paths<F>& p, Vec3<F> unit_vector, Event<F>& e) {
  const F towards = dot(p.ray.direction, e.at.normal);
  const auto exiting = less(F(0.0f), towards);
  const Vec3<F> facing = select(exiting, -e.at.normal, e.at.normal);
  e.incident = {p.ray.direction, e.at.normal, facing,    min(abs(towards), F(1.0f)),
                exiting,         unit_vector, s.schlick, p.sampler};
  const IntOf<F> one = IntOf<F>(1), zero = IntOf<F>(0);
  const IntOf<F> inside = select(exiting, select(e.at.inverted, zero, one), select(e.at.inverted, one, zero));
  e.point = select(e.surface, e.at.point, e.point);
  e.from = select(e.surface, e.at.element * IntOf<F>(4) + inside, e.from);
}

/// Draws where the paths scatter in media (fly_through_media()), and applies absorption up to there to the throughput.
template <class F>
TYNDALL_INLINE void cross_media(const auto& s, Paths<F>& p, MaskOf<F> active, F& nearest, MediumEvent<F>& event) {
  fly_through_media(s, p.ray, p.sampler, active, nearest, event);
  p.throughput = transmitted_by_absorbers(s, p.ray, p.sampler, nearest, active) * p.throughput;
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

}  // namespace tyndall
