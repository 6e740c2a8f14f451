#pragma once
#include "core/trace/shade.h"
#include "core/transport/direct_light.h"

/// What paths meet: points on surfaces and points in media.
namespace tyndall {

/// Looks up what the lanes in e.surface have hit: the point, its material and its colour.
template <class F>
TYNDALL_INLINE void meet_surfaces(const auto& s, const Ray<F>& ray, const Hit<F>& hit, Event<F>& e) {
  e.at = surface_at(s, ray, hit.t, hit.element);
  e.kind = lookup<F>(s.kind, s.material_count, e.at.material);
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
      const IntOf<F> light = lookup<F>(s.light_of, s.element_count, e.at.element);
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
