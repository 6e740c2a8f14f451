#pragma once
#include "core/specular/specular_light.h"
#include "core/trace/lane_pool.h"
#include "core/transport/alone_samples.h"
#include "core/transport/guided_light.h"

/// Light that specular paths bring to the events of a path. It is solved for (core/specular), and added to the film
/// apart from the radiance that the path itself gathers.
namespace tyndall {

/// Waiting requests. At any time only few lanes of a group are at an event that requests specular paths, so requests
/// wait until they fill all lanes. The queue is first in, first out, so that the events of one path are answered in
/// their order.
template <class F>
using SpecularQueue = LanePool<F, 11, 7>;

/// The requests for the light of specular paths, and for that of guided paths.
template <class F>
struct WaitingRequests {
  SpecularQueue<F> specular, guided;
  std::uint32_t guided_rays = 0;  ///< traced where requests do not wait; shadow rays left out
  TYNDALL_INLINE bool empty() const { return specular.count == 0 && guided.count == 0; }
};

/// Requests light for the events in `lanes`. With one lane the answer, light_of(request), is added to the path's
/// radiance at once. slot: where the light is to be added.
template <class F>
TYNDALL_INLINE void request_light(const auto& s, Paths<F>& p, const Event<F>& e, MaskOf<F> lanes, IntOf<F> slot,
                                  SpecularQueue<F>& waiting, auto& recorder, const auto& light_of) {
  Vec3<F> carried = p.throughput * e.colour;
  if constexpr (SpecularQueue<F>::waits) carried = weighed(s, p, carried);
  const Vec3<F> facing = select(e.medium, p.ray.direction, e.incident.facing);
  SpecularRequest<F> request{e.point, facing, carried, p.ray.time, e.g, e.from, p.depth, slot, p.sampler, e.medium};
  if constexpr (SpecularQueue<F>::waits) {
    append_lanes<F>(s, request, lanes, waiting);
  } else if (any(lanes)) {
    const Vec3<F> light = light_of(request);
    recorder.on_specular_path_light(light);
    p.radiance = p.radiance + light;
  }
}

/// Requests specular paths, at random, from events at diffuse surfaces and in media; see request_light().
template <class F>
TYNDALL_INLINE void request_specular_paths(const auto& s, Paths<F>& p, Event<F>& e, MaskOf<F> scattering, IntOf<F> slot,
                                           SpecularQueue<F>& waiting, auto& recorder, std::uint32_t& shadow_rays) {
  const auto spreads = accepts_specular_paths(s, e);
  if (any(spreads)) e.connect_probability = connect_probability(s, e.point);
  const auto drawn = less(p.sampler.independent_1d(dimension::specular_connect), e.connect_probability);
  const auto receiver = mask_and(mask_and(scattering, drawn), spreads);
  request_light(s, p, e, receiver, slot, waiting, recorder,
                [&](const SpecularRequest<F>& q) { return specular_light(shared_view(s), q, receiver, shadow_rays); });
}

/// Requests guided light, at random, from events at diffuse surfaces; see request_light().
template <class F>
TYNDALL_INLINE void request_guided_light(const auto& s, Paths<F>& p, const Event<F>& e, MaskOf<F> scattering,
                                         IntOf<F> slot, WaitingRequests<F>& waiting, auto& recorder,
                                         std::uint32_t& shadow_rays) {
  const auto diffuse = mask_and(mask_and(scattering, e.surface), has_trait<&BsdfTraits::diffuse>(s, e.kind));
  if (!any(diffuse)) return;
  const F probability = guided_query_probability<F>(s, e.point, diffuse);
  const auto drawn = mask_and(diffuse, less(p.sampler.independent_1d(dimension::guided_query), probability));
  request_light(s, p, e, drawn, slot, waiting.guided, recorder, [&](const SpecularRequest<F>& q) {
    return guided_light(s, q, drawn, waiting.guided_rays, shadow_rays);
  });
}

/// Answers the first requests of a queue, as many as there are lanes, and removes them. light_of(request, lanes, rays,
/// shadow_rays) is their light. Calls add(slot, light) in turn for each request whose light is not 0.
template <class F>
TYNDALL_INLINE void answer_queue(const auto& s, SpecularQueue<F>& waiting, TileCounts& counts, const auto& light_of,
                                 const auto& add) {
  constexpr int lanes = lanes_of<F>;
  const int count = waiting.count < lanes ? waiting.count : lanes;
  SpecularRequest<F> request{};
  request.sampler.kind = s.sampler;
  load_lanes<F>(s, waiting, 0, request);
  std::uint32_t rays = 0, shadow_rays = 0;
  const Vec3<F> light = light_of(request, mask_from_bits<F>(first_lanes(count)), rays, shadow_rays);
  counts.rays += rays + shadow_rays, counts.shadow_rays += shadow_rays;
  alignas(64) float r[lanes], g[lanes], b[lanes];
  store(r, light.x), store(g, light.y), store(b, light.z);
  constexpr int slots = 2;  // row of the requests' slots: see each_part()
  for (int i = 0; i < count; ++i)
    if (r[i] != 0 || g[i] != 0 || b[i] != 0) add(waiting.integer[slots][i], Vec3f{r[i], g[i], b[i]});
  waiting.count -= count;
  if (waiting.count == 0) return;
  for (auto& column : waiting.number) store(column, load<F>(column + lanes));
  for (auto& column : waiting.integer) store(column, load<F>(column + lanes));
}

/// Answers the queues that fill all lanes. rest: those that do not, too.
template <class F>
TYNDALL_INLINE void answer_full_queues(const auto& s, WaitingRequests<F>& waiting, bool rest, TileCounts& counts,
                                       const auto& add) {
  const auto is_due = [rest](const SpecularQueue<F>& queue) __attribute__((always_inline)) {
    return queue.count >= lanes_of<F> || (rest && queue.count > 0);
  };
  const auto specular = [&](const SpecularRequest<F>& q, MaskOf<F> lanes, std::uint32_t&, std::uint32_t& shadow_rays)
      __attribute__((always_inline)) {
    return specular_light(shared_view(s), q, lanes, shadow_rays);
  };
  if (s.has_specular_paths() && is_due(waiting.specular)) answer_queue(s, waiting.specular, counts, specular, add);
  const auto guided = [&](const SpecularRequest<F>& q, MaskOf<F> lanes, std::uint32_t& rays, std::uint32_t& shadow_rays)
      __attribute__((always_inline)) {
    return guided_light(s, q, lanes, rays, shadow_rays);
  };
  if (s.has_guide() && is_due(waiting.guided)) answer_queue(s, waiting.guided, counts, guided, add);
}

}  // namespace tyndall
