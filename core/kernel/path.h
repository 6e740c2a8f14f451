#pragma once
#include "core/kernel/chain_light.h"
#include "core/kernel/near_lights.h"
#include "core/kernel/path_pool.h"
#include "core/kernel/share.h"

#include <type_traits>

/// The path loop: all lanes of a group take a step, each with a path of its own, and no lane waits for the others
/// (path_pool.h).
namespace tyndall {

/// Finds the lanes in which `part` of the path's state is not finite, and returns them. Their radiance is made not a
/// number, so that the film rejects and counts the sample.
template <class F>
TYNDALL_INLINE MaskOf<F> lose(Paths<F>& p, MaskOf<F> lanes, Vec3<F> part) {
  const F sum = F(0.0f) * part.x + F(0.0f) * part.y + F(0.0f) * part.z;  // 0, or not a number
  const auto lost = mask_and_not(lanes, equal(sum, F(0.0f)));
  if (any(lost)) p.radiance = select(lost, Vec3<F>{sum, sum, sum}, p.radiance);
  return lost;
}

/// Events that ask for chains. Only few lanes of a group are at such an event at a time, so events wait here until
/// there are enough to fill all lanes, first come, first served: so the chains of one path are found in the order of
/// its events. The light that a chain brings is added to the film apart from that of its path. With one lane (float,
/// double) nothing waits.
template <class F>
struct ChainQueue {
  static constexpr bool waits = lanes_of<F> > 1;
  static constexpr int room = waits ? 2 * lanes_of<F> : 1, numbers = 11, words = 7;
  alignas(64) float number[numbers][room];
  alignas(64) std::int32_t word[words][room];
  int count = 0;
};

template <class F>
TYNDALL_INLINE void enqueue(ChainQueue<F>& queue, const Paths<F>& p, const Event<F>& e, IntOf<F> slot,
                            MaskOf<F> lanes) {
  using I = IntOf<F>;
  using Queue = ChainQueue<F>;
  const Vec3<F> heading = select(e.medium, p.ray.direction, e.incident.facing),
                carried = p.weight * (p.throughput * e.colour);
  const F numbers[Queue::numbers] = {e.point.x, e.point.y, e.point.z, heading.x,  heading.y, heading.z,
                                     carried.x, carried.y, carried.z, p.ray.time, e.g};
  const I words[Queue::words] = {e.from,
                                 p.depth,
                                 slot,
                                 as_int(p.dice.low),
                                 as_int(p.dice.high),
                                 as_int(p.dice.event),
                                 select(e.medium, I(1), I(0))};
  for (int k = 0; k < Queue::numbers; ++k) append(queue.number[k] + queue.count, numbers[k], lanes);
  for (int k = 0; k < Queue::words; ++k) append(queue.word[k] + queue.count, words[k], lanes);
  queue.count += __builtin_popcount(bits(lanes));
}

/// Whether the kernel whose paths are noted in a `Shared` shares second vertices.
template <class Shared>
inline constexpr bool shares_vertices = std::is_same_v<std::remove_cvref_t<Shared>, SharedPaths>;

/// In kernels that share: what is added to the slot of a path whose events leave its second vertex.
inline constexpr std::int32_t leaves_second = 1 << 30;

/// Asks for chains, at random, from events that scatter evenly.
template <bool shares, class F>
TYNDALL_INLINE void ask_for_chains(const auto& s, Paths<F>& p, Event<F>& e, MaskOf<F> scattering, ChainQueue<F>& chains,
                                   std::uint32_t& shadow_rays) {
  const auto evenly = mask_and(e.surface, equal(e.kind, IntOf<F>(kind_of<Lambertian<double>>())));
  const auto spreads = mask_or(e.medium, evenly);
  if (any(spreads)) e.asks = chain_probability(s, e.point);
  const auto drawn = less(p.dice.one_alone(dimension::chain_asked), e.asks);
  const auto asking = mask_and(mask_and(scattering, drawn), spreads);
  IntOf<F> slot = p.slot;
  if constexpr (shares) slot = select(mask_from_bits<F>(p.second), slot + IntOf<F>(leaves_second), slot);
  if constexpr (ChainQueue<F>::waits)
    enqueue(chains, p, e, slot, asking);
  else if (any(asking))
    p.radiance = p.radiance + chain_light(s, p, e, asking, shadow_rays);
}

/// Takes all active lanes one step further: to the next surface, the next event in a medium, or out of the scene.
/// Returns which lanes go on, and sets `cut` to those that ended because of max_depth. shared: SharedPaths, or
/// NoSharing.
template <class F>
TYNDALL_INLINE MaskOf<F> step(const auto& s, Paths<F>& p, MaskOf<F> active, MaskOf<F>& cut, ChainQueue<F>& chains,
                              auto& shared, std::uint32_t& shadow_rays) {
  constexpr bool shares = shares_vertices<decltype(shared)>;
  Hit<F> hit = closest(s, p.ray, active);
  MediumEvent<F> found = no_event<F>();
  const F to_surface = hit.t;
  const Vec3<F> before = p.throughput;
  if (s.has_media()) cross_media(s, p, active, hit.t, found);
  Event<F> e = event_on(p.ray, p.dice);
  e.medium = found.happens;
  e.surface = mask_and(active, mask_and_not(less_equal(IntOf<F>(0), hit.element), e.medium));
  const auto escaped = mask_and_not(mask_and_not(active, e.surface), e.medium);
  if (s.needs.background && any(escaped))
    p.radiance =
        select(escaped, p.radiance + p.throughput * background_radiance(s.background, p.ray.direction), p.radiance);
  const Pair<F> u = p.dice.pair(dimension::direction);
  const Vec3<F> unit = on_sphere(u);
  if (any(e.surface)) meet_surfaces(s, p, hit, unit, e);
  if (s.has_media() && any(e.medium)) meet_media(s, found, e);
  if (s.has_lamps_in_fog()) light_near_lamps(s, p, before, found, active, Pair<F>{hit.t, to_surface}, shadow_rays);
  const auto met = mask_or(e.surface, e.medium);
  if constexpr (shares) {
    const auto second = mask_and(mask_and(met, scatters_evenly(s, e)),
                                 mask_and(equal(p.depth, IntOf<F>(1)), mask_from_bits<F>(p.first)));
    if (any(second)) note_second(s, p, e, second, shared), p.second |= bits(second);
  }
  Vec3<F> carried = p.throughput * e.colour;
  const auto lost = lose(p, met, carried + e.point);
  // A path that carries nothing any more has ended by itself: it does not count as cut.
  const auto useful = mask_and(mask_and_not(met, lost), less(F(0.0f), max_component(carried)));
  const auto deep = less_equal(IntOf<F>(s.max_depth), p.depth);
  cut = mask_and(useful, deep);
  const auto scattering = mask_and_not(useful, deep);
  auto first = less(F(1.0f), F(0.0f));
  if constexpr (shares) {
    first = mask_and(mask_and(scattering, scatters_evenly(s, e)), equal(p.depth, IntOf<F>(0)));
    if (any(first)) note_first(s, p, e, first, shared), p.first |= bits(first);
  }
  if (s.light_sampling && any(scattering)) {
    const LightAsked<F> asked{choose_light(s.lights, e.point, p.dice.one(dimension::light_choice)),
                              p.dice.pair(dimension::light_point), p.flight, false};
    p.radiance = p.radiance + direct_light(s, p, e, scattering, asked, shadow_rays);
  }
  if (s.has_chains()) ask_for_chains<shares>(s, p, e, scattering, chains, shadow_rays);
  F weight;
  const auto on = mask_and(scattering, scatter(s, p, e, unit, u, weight));
  if (s.has_chains()) carried = select(on, weight * carried, carried);
  if (p.straight) {
    const auto mirrored = mask_and(mask_and(on, e.surface), is_narrow(p.density));
    p.straight &= ~bits(mask_and_not(scattering, mirrored));
  }
  const auto lanes = mask_and_not(on, lose(p, on, p.ray.direction));
  p.throughput = select(mask_or(lanes, cut), carried, p.throughput);
  p.depth = p.depth + IntOf<F>(1);
  const auto spared = s.has_chains() ? mask_or(first, seeks_glint(p)) : first;
  const auto survivors = shares || s.has_chains() ? roulette_but(p, lanes, spared) : roulette(p, lanes);
  p.dice.next_event();
  return survivors;
}

/// Where the samples of a unit go.
struct UnitFilm {
  double per_unit;
  FilmPixel* pixels;
  EmissionSums* emission;  ///< null: not recorded
  UnitCounts& counts;
};

/// Adds the samples of finished lanes to the unit's pixels; max_depth ended the lanes in `cut`.
template <class F>
TYNDALL_INLINE void finish(const auto& s, const Paths<F>& p, std::uint32_t finished, std::uint32_t cut,
                           const UnitFilm& film) {
  if (!finished) return;
  alignas(64) float r[lanes_of<F>], g[lanes_of<F>], b[lanes_of<F>], carried[lanes_of<F>];
  alignas(64) std::int32_t slot[lanes_of<F>];
  Vec3<F> sample = p.radiance;
  F left = max_component(p.throughput);
  if (s.has_chains()) sample = p.weight * sample, left = p.weight * left;
  store(r, sample.x), store(g, sample.y), store(b, sample.z), store(slot, p.slot);
  store(carried, left);
  const std::uint32_t straight = film.emission ? p.straight : 0;
  for (; finished; finished &= finished - 1) {
    const int lane = __builtin_ctz(finished);
    FilmPixel& pixel = film.pixels[slot[lane] >> 1];
    const std::uint32_t half = static_cast<std::uint32_t>(slot[lane]) & 1u;
    const Vec3f radiance{r[lane], g[lane], b[lane]};
    add_sample(pixel, half, radiance, film.per_unit);
    if (straight >> lane & 1u) add_emission(film.emission[slot[lane] >> 1], half, radiance, film.per_unit);
    ++pixel.taken;
    if (!(cut >> lane & 1u)) continue;
    ++pixel.truncated;
    film.counts.cut_throughput.add(static_cast<double>(carried[lane]));
  }
}

/// Looks for chains from the first events of the queue, as many as there are lanes, and removes these events. Calls
/// add(slot, light) for each in turn that brings some.
template <class F>
TYNDALL_INLINE void find_waiting_chains(const auto& s, ChainQueue<F>& queue, UnitCounts& counts, const auto& add) {
  using I = IntOf<F>;
  constexpr int lanes = lanes_of<F>;
  const int count = queue.count < lanes ? queue.count : lanes;
  const auto number = [&](int k) { return load<F>(queue.number[k]); };
  const auto word = [&](int k) { return load_int<F>(queue.word[k]); };
  const auto asking = mask_from_bits<F>(count >= 32 ? 0xffffffffu : (1u << (count % 32)) - 1u);
  Paths<F> p{};
  Event<F> e{};
  e.point = {number(0), number(1), number(2)};
  p.ray.direction = e.incident.facing = {number(3), number(4), number(5)};
  p.throughput = {number(6), number(7), number(8)};
  p.ray.time = number(9), e.g = number(10);
  e.from = word(0), p.depth = word(1), p.slot = word(2);
  p.dice = {as_uint(word(3)), as_uint(word(4)), as_uint(word(5)), s.sampler};
  e.medium = equal(word(6), I(1)), e.surface = mask_not(e.medium);
  e.colour = {F(1.0f), F(1.0f), F(1.0f)};
  std::uint32_t shadow_rays = 0;
  const Vec3<F> light = chain_light(s, p, e, asking, shadow_rays);
  counts.rays += shadow_rays, counts.shadow_rays += shadow_rays;
  alignas(64) float r[lanes], g[lanes], b[lanes];
  store(r, light.x), store(g, light.y), store(b, light.z);
  for (int i = 0; i < count; ++i)
    if (r[i] != 0 || g[i] != 0 || b[i] != 0) add(queue.word[2][i], Vec3f{r[i], g[i], b[i]});
  queue.count -= count;
  if (queue.count == 0) return;
  for (auto& column : queue.number) store(column, load<F>(column + lanes));
  for (auto& column : queue.word) store(column, load_int<F>(column + lanes));
}

/// Follows paths until all samples are done. end(p, finished, cut): the paths in the lanes `finished` have ended, those
/// in `cut` because of max_depth. add(slot, light): a chain brings light to the path of that slot.
template <class F>
TYNDALL_INLINE void follow_paths(const auto& s, auto& samples, auto& shared, UnitCounts& counts, const auto& end,
                                 const auto& add) {
  constexpr bool shares = shares_vertices<decltype(shared)>;
  PathPool<F> pool{};
  ChainQueue<F> chains{};
  Paths<F> p{};
  p.dice.sampler = s.sampler;
  // The loop goes on until no event waits for a chain. A second loop for the last of them would put their code into
  // each kernel twice.
  for (bool sampling = true; sampling || chains.count > 0;) {
    take_paths<shares>(s, p, pool, samples);
    sampling = p.alive != 0;
    if (sampling) {
      counts.rays += static_cast<std::uint64_t>(__builtin_popcount(p.alive)), ++counts.steps;
      MaskOf<F> cut;
      std::uint32_t shadow_rays = 0;
      const std::uint32_t survivors =
          bits(step(s, p, mask_from_bits<F>(p.alive), cut, chains, shared, shadow_rays)) & p.alive;
      counts.rays += shadow_rays, counts.shadow_rays += shadow_rays;
      end(p, p.alive & ~survivors, bits(cut));
      p.alive = survivors;
    }
    if constexpr (ChainQueue<F>::waits) {
      const bool full = chains.count >= lanes_of<F>, rest = !sampling && chains.count > 0;
      if (s.has_chains() && (full || rest)) find_waiting_chains(s, chains, counts, add);
    }
  }
}

template <class F>
TYNDALL_INLINE void render_unit(const auto& s, const Unit& unit, const UnitFilm& film) {
  UnitSamples samples;
  list_samples(s, unit, samples);
  NoSharing alone;
  const auto end = [&](const Paths<F>& p, std::uint32_t finished, std::uint32_t cut) __attribute__((always_inline)) {
    finish(s, p, finished, cut, film);
  };
  const auto add = [&](std::int32_t slot, Vec3f light) {
    add_sample(film.pixels[slot >> 1], static_cast<std::uint32_t>(slot) & 1u, light, film.per_unit);
  };
  follow_paths<F>(s, samples, alone, film.counts, end, add);
}

}  // namespace tyndall
