#pragma once
#include "core/specular/specular_light.h"
#include "core/trace/lane_pool.h"
#include "core/transport/alone_samples.h"
#include "core/transport/direct_light.h"

/// Light that specular paths bring to the events of a path. It is solved for (core/specular), and added to the film
/// apart from the radiance that the path itself gathers.
namespace tyndall {

/// Waiting requests. At any time only few lanes of a group are at an event that requests specular paths, so requests
/// wait until they fill all lanes. The queue is first in, first out, so that the events of one path are answered in
/// their order.
template <class F>
using SpecularQueue = LanePool<F, 11, 7>;

/// Requests specular paths, at random, from events at diffuse surfaces and in media. With one lane the answer is added
/// to the path's radiance at once. slot: where the light is to be added.
template <class F>
TYNDALL_INLINE void request_specular_paths(const auto& s, Paths<F>& p, Event<F>& e, MaskOf<F> scattering, IntOf<F> slot,
                                           SpecularQueue<F>& waiting, auto& recorder, std::uint32_t& shadow_rays) {
  const auto spreads = accepts_specular_paths(s, e);
  if (any(spreads)) e.connect_probability = connect_probability(s, e.point);
  const auto drawn = less(p.sampler.independent_1d(dimension::specular_connect), e.connect_probability);
  const auto receiver = mask_and(mask_and(scattering, drawn), spreads);
  Vec3<F> carried = p.throughput * e.colour;
  if constexpr (SpecularQueue<F>::waits) carried = p.weight * carried;
  SpecularRequest<F> request{e.point,   select(e.medium, p.ray.direction, e.incident.facing),
                             carried,   p.ray.time,
                             e.g,       e.from,
                             p.depth,   slot,
                             p.sampler, e.medium};
  if constexpr (SpecularQueue<F>::waits) {
    append_lanes<F>(s, request, receiver, waiting);
  } else if (any(receiver)) {
    const Vec3<F> light = specular_light(s, request, receiver, shadow_rays);
    recorder.on_specular_path_light(light);
    p.radiance = p.radiance + light;
  }
}

/// Answers the first requests of the queue, as many as there are lanes, and removes them. Calls add(slot, light) in
/// turn for each request whose light is not 0.
template <class F>
TYNDALL_INLINE void answer_requests(const auto& s, SpecularQueue<F>& waiting, TileCounts& counts, const auto& add) {
  constexpr int lanes = lanes_of<F>;
  const int count = waiting.count < lanes ? waiting.count : lanes;
  SpecularRequest<F> request{};
  request.sampler.kind = s.sampler;
  load_lanes<F>(s, waiting, 0, request);
  std::uint32_t shadow_rays = 0;
  const Vec3<F> light = specular_light(s, request, mask_from_bits<F>(first_lanes(count)), shadow_rays);
  counts.rays += shadow_rays, counts.shadow_rays += shadow_rays;
  alignas(64) float r[lanes], g[lanes], b[lanes];
  store(r, light.x), store(g, light.y), store(b, light.z);
  constexpr int slots = 2;  // row of the requests' slots: see each_part()
  for (int i = 0; i < count; ++i)
    if (r[i] != 0 || g[i] != 0 || b[i] != 0) add(waiting.integer[slots][i], Vec3f{r[i], g[i], b[i]});
  waiting.count -= count;
  if (waiting.count == 0) return;
  for (auto& column : waiting.number) store(column, load<F>(column + lanes));
  for (auto& column : waiting.integer) store(column, load_int<F>(column + lanes));
}

}  // namespace tyndall
