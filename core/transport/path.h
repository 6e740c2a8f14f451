#pragma once
#include "core/transport/near_lights.h"
#include "core/transport/scatter.h"
#include "core/transport/specular_queue.h"
#include "core/transport/splitting.h"

/// The path tracer. A sample estimates the light that reaches a point of the film,
///
///   L = sum over paths x0 x1 ... xk of  We(x0, x1) · product of (f · cos / pdf) at x1 ... x(k-1) · Le(xk -> x(k-1)),
///
/// where x0 is on the lens and xk on a light or in the background (M. Pharr, W. Jakob, G. Humphreys, Physically Based
/// Rendering, 4th edition, section 13.2). Each step makes the paths in all lanes one vertex longer; no lane waits for
/// the others (paths.h). Light that several strategies can find is weighted by the power heuristic (E. Veach,
/// Robust Monte Carlo Methods for Light Transport Simulation, 1997, section 9.2): sampling the BSDF or the phase
/// function, sampling lights, and in scenes that have them, specular paths (core/specular), guided paths (core/guide)
/// and flights that end next to small lights in media (near_lights.h).
namespace tyndall {

/// A recorder that records nothing. Others (core/targets) get these calls, in this order, in each step of a path.
struct NoRecorder {
  TYNDALL_INLINE void on_event(const auto&...) {}
  TYNDALL_INLINE void on_weight_against_specular_paths(const auto&) {}
  TYNDALL_INLINE void on_specular_path_light(const auto&) {}
  TYNDALL_INLINE void on_branches(const auto&) {}
  TYNDALL_INLINE void on_end(const auto&...) {}
};

/// The lanes that a step leaves alive, and those that it cut.
template <class F>
struct StepResult {
  MaskOf<F> survivors;  ///< their paths go on
  MaskOf<F> cut;        ///< max_depth ended their paths
};

/// Direct light: one light and one shadow ray, and requests for the light of specular and guided paths.
template <class F>
TYNDALL_INLINE void add_direct_light(const auto& s, Paths<F>& p, Event<F>& e, MaskOf<F> scattering, auto& samples,
                                     WaitingRequests<F>& waiting, auto& recorder, std::uint32_t& shadow_rays) {
  if (s.light_sampling && any(scattering)) {
    const F choice = s.samples_sky() || s.lights.count() > 1 ? p.sampler.next_1d(dimension::light_choice) : F(0.0f);
    const LightQuery<F> query{choose_light_or_sky(s, e.point, choice), p.sampler.next_2d(dimension::light_point),
                              p.flight, false};
    Vec3<F> light = direct_light(s, p, e, scattering, query, shadow_rays);
    if (s.has_guide()) light = weigh_beside_guide(s, p, e, light);
    p.radiance = p.radiance + light;
  }
  if (s.has_specular_paths())
    request_specular_paths(s, p, e, scattering, samples.slot_of(p), waiting.specular, recorder, shadow_rays);
  if (s.has_guide()) request_guided_light(s, p, e, scattering, samples.slot_of(p), waiting, recorder, shadow_rays);
}

/// Takes the paths in `active` one step further: to the next surface, the next event in a medium, or out of the scene.
/// Lanes that end have their whole sample in p.radiance, except for the requests still in `waiting`.
///
/// s:        a SceneView, reduced to the models that this kernel has
/// samples:  source of the samples and receiver of their light, see AloneSamples
/// waiting:  requests for the light of specular and guided paths
/// pool:     receives the branches of paths that split
/// recorder: see NoRecorder
template <class F>
TYNDALL_INLINE StepResult<F> step(const auto& s, Paths<F>& p, MaskOf<F> active, auto& samples,
                                  WaitingRequests<F>& waiting, auto& pool, auto& recorder, std::uint32_t& shadow_rays) {
  // ---- intersect: a surface, or before it an event in a medium
  Hit<F> hit = closest(s, p.ray, active);
  MediumEvent<F> found = no_event<F>();
  const F to_surface = hit.t;
  const Vec3<F> at_start = p.throughput;
  if (s.has_media()) cross_media(s, p, active, hit.t, found);
  Event<F> e = event_on(p.ray, p.sampler);
  e.medium = found.happens;
  e.surface = mask_and(active, mask_and_not(less_equal(IntOf<F>(0), hit.element), e.medium));
  const auto escaped = mask_and_not(mask_and_not(active, e.surface), e.medium);
  if (any(e.surface)) meet_surfaces(s, p.ray, hit, e);

  // ---- emission: of the background, and of lights that the paths have hit
  if (s.features.background && any(escaped))
    p.radiance = select(escaped, p.radiance + p.throughput * found_background(s, p, escaped, recorder), p.radiance);
  if (any(e.surface)) add_emission(s, p, hit, e, recorder);

  // ---- the event, and the light of small lights in media that the path has passed
  const Pair<F> u = p.sampler.next_2d(dimension::direction);
  const Vec3<F> unit_vector = on_sphere(u);
  if (any(e.surface)) describe_incidence(s, p, unit_vector, e);
  if (s.has_media() && any(e.medium)) meet_media(s, found, e);
  if (s.has_lights_in_media()) add_near_lights(s, p, at_start, found, active, Pair<F>{hit.t, to_surface}, shadow_rays);
  recorder.on_event(s, p, hit, found, e);

  // ---- ends: of paths that carry no light, or a number that is not finite, or that are as long as max_depth
  const auto met = mask_or(e.surface, e.medium);
  samples.on_event(s, p, e, met);
  Vec3<F> carried = p.throughput * e.colour;
  const auto useful =
      mask_and(mask_and_not(met, lose(p, met, carried + e.point)), less(F(0.0f), max_component(carried)));
  const auto deep = less_equal(IntOf<F>(s.max_depth), p.depth);
  const auto cut = mask_and(useful, deep), scattering = mask_and_not(useful, deep);
  auto exempt = samples.on_scatter(s, p, e, scattering);

  add_direct_light(s, p, e, scattering, samples, waiting, recorder, shadow_rays);

  // ---- sample the BSDF or the phase function
  F weight;
  const auto on = mask_and(scattering, scatter(s, p, e, unit_vector, u, weight));
  if (s.has_specular_paths() || !has_constant_weights<decltype(s)>) carried = select(on, weight * carried, carried);
  if (p.straight) {
    const auto mirrored = mask_and(mask_and(on, e.surface), is_narrow_lobe(p.pdf));
    p.straight &= ~bits(mask_and_not(scattering, mirrored));
  }
  const auto branches = split_at_glass(s, p, e, on, carried, pool);
  const auto lanes = mask_and_not(on, lose(p, on, p.ray.direction));
  p.throughput = select(mask_or(lanes, cut), carried, p.throughput);
  p.depth = p.depth + IntOf<F>(1);

  // ---- Russian roulette
  if (s.has_specular_paths()) exempt = mask_or(exempt, seeks_subpixel_light(p));
  const auto survivors = roulette(p, lanes, exempt);
  p.sampler.next_event();
  recorder.on_branches(branches);
  recorder.on_end(p, on, StepResult<F>{survivors, cut});
  return {survivors, cut};
}

/// Follows paths until all samples are done and all requests for the light of specular paths are answered.
template <class F>
TYNDALL_INLINE void follow_paths(const auto& s, auto& samples, TileCounts& counts, auto& recorder) {
  PathPool<F, std::remove_cvref_t<decltype(s)>::can_split> pool;
  clear<F>(pool);
  WaitingRequests<F> waiting{};
  Paths<F> p{};
  p.sampler.kind = s.sampler;
  // One loop for paths and for the last requests: a second loop would put the code of requests into each kernel twice.
  for (bool sampling = true; sampling || !waiting.empty();) {
    take_paths(s, p, pool, samples);
    sampling = p.alive != 0;
    if (sampling) {
      counts.rays += static_cast<std::uint64_t>(__builtin_popcount(p.alive)), ++counts.steps;
      std::uint32_t shadow_rays = 0;
      const int before = pool.count;
      const StepResult<F> end = step(s, p, mask_from_bits<F>(p.alive), samples, waiting, pool, recorder, shadow_rays);
      counts.splits += static_cast<std::uint64_t>(pool.count - before);
      const std::uint32_t survivors = bits(end.survivors) & p.alive;
      counts.rays += shadow_rays + waiting.guided_rays, counts.shadow_rays += shadow_rays, waiting.guided_rays = 0;
      samples.on_end(s, p, p.alive & ~survivors, bits(end.cut));
      p.alive = survivors;
    }
    if constexpr (SpecularQueue<F>::waits) {
      const auto add = [&](std::int32_t slot, Vec3f light) { samples.add(slot, light); };
      answer_full_queues(s, waiting, !sampling, counts, add);
    }
  }
}

}  // namespace tyndall
