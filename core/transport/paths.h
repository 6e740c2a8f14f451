#pragma once
#include "core/guide/guide_trail.h"
#include "core/specular/specular_trail.h"
#include "core/trace/camera.h"
#include "core/trace/flight.h"
#include "core/trace/lane_pool.h"
#include "core/trace/subpixel_lights.h"

/// The state of the paths in a group of lanes, and the paths that wait between two events. All lanes take a step
/// together: either with new samples, whose rays lie side by side and hit much the same objects, or with paths that
/// already had events. When too few paths survive a step to make another one worth while, they wait until there are
/// enough to fill all lanes.
namespace tyndall {

/// All that a group of paths carries from event to event.
template <class F>
struct Paths {
  Ray<F> ray;
  Vec3<F> throughput, radiance;
  Sampler<F> sampler;
  IntOf<F> depth;  ///< scattering events so far
  F pdf;  ///< of the ray's direction, per steradian; one_direction: light sampling cannot choose this direction
  MediumFlight<F> flight;   ///< the flight to the ray's origin; only in scenes with lights in media
  SpecularTrail<F> trail;   ///< events since it last scattered; only in scenes with specular paths
  GuideTrail<F> guide;      ///< likewise; only in scenes with a guide
  IntOf<F> slot;            ///< 2 · pixel within the tile + half; in kernels that reuse paths an index of ReusedPaths
  F weight;                 ///< of the sample, see subpixel_lights.h; only with has_sample_weights()
  GlassRoute<F> route;      ///< remaining events to a subpixel light; only in scenes with specular paths
  std::uint32_t alive = 0;  ///< bit i: lane i follows a path
  /// Bit i: the path has met only smooth glass and mirrors so far; 0 without lights and without splitting.
  std::uint32_t straight = 0;
  std::uint32_t branch = 0;  ///< bit i: the path is a branch (splitting.h); its sample is counted by another path
  /// Bit i: the path's first, or second, vertex takes part in reuse (reuse.h). 0 in kernels without reuse.
  std::uint32_t first = 0, second = 0;
};

/// Lanes steered to a subpixel light: they were drawn in its box, and have met only smooth glass and mirrors so far.
template <class F>
TYNDALL_INLINE MaskOf<F> seeks_subpixel_light(const Paths<F>& p) {
  return mask_and(p.route.is_set(), mask_from_bits<F>(p.straight));
}

/// `colour`, what a path has gathered or carries, times the weight of its sample (subpixel_lights.h).
template <class F>
TYNDALL_INLINE Vec3<F> weighed(const auto& s, const Paths<F>& p, Vec3<F> colour) {
  return has_sample_weights(s) ? p.weight * colour : colour;
}

/// Returns the lanes in which `part` of the path's state is not finite. Sets their radiance to not a number, so that
/// the film rejects and counts the sample.
template <class F>
TYNDALL_INLINE MaskOf<F> lose(Paths<F>& p, MaskOf<F> lanes, Vec3<F> part) {
  const F sum = F(0.0f) * part.x + F(0.0f) * part.y + F(0.0f) * part.z;  // 0, or not a number
  const auto lost = mask_and_not(lanes, equal(sum, F(0.0f)));
  if (any(lost)) p.radiance = select(lost, Vec3<F>{sum, sum, sum}, p.radiance);
  return lost;
}

/// With one lane only branches wait; the last one is followed first, so that at most max_splits of them wait.
template <class F>
struct WaitingBranches {
  Paths<F> path[max_splits];
  int count = 0;
};

/// The groups of lanes for which there is room where paths split. Between two steps max_splits + 1 groups wait at most:
/// new samples start when less than one group waits, and a step adds at most one group to what waits. All paths that
/// are followed while more than k groups wait are offspring of those that were followed when there were k groups for
/// the last time, because the path that was added last is followed first; so they have had k events at least, and after
/// max_splits no path splits. A step stores up to two groups before the next paths are taken, and append_lanes() writes
/// up to one behind them. One more keeps rows from being a power of two apart, which would put them into the same few
/// sets of the cache.
inline constexpr int pool_groups = max_splits + 5;

template <class F, bool can_split>
using PathPool = std::conditional_t<Plain<F>, WaitingBranches<F>, LanePool<F, 36, 11, can_split ? pool_groups : 2>>;

/// Empties a pool, and clears the columns in which load_lanes() may read behind the last path.
template <class F>
TYNDALL_INLINE void clear(auto& pool) {
  pool.count = 0;
  if constexpr (!Plain<F>) {
    for (int i = 0; i < 2 * lanes_of<F>; ++i) {
      for (auto& column : pool.number) column[i] = 0;
      for (auto& column : pool.integer) column[i] = 0;
    }
  }
}

/// The bit masks of Paths (straight, first, second, branch) as one integer in each lane, whose bits 0 to 3 they are.
template <class F>
TYNDALL_INLINE IntOf<F> marks_of(const auto& s, const Paths<F>& p) {
  const auto mark = [](std::uint32_t lanes, std::int32_t value) __attribute__((always_inline)) {
    return select(mask_from_bits<F>(lanes), IntOf<F>(value), IntOf<F>(0));
  };
  IntOf<F> straight = mark(p.straight, 1);
  if (s.has_splitting()) straight = straight + mark(p.branch, 8);
  return s.has_reuse() ? straight + mark(p.first, 2) + mark(p.second, 4) : straight;
}
template <class F>
TYNDALL_INLINE void set_marks(const auto& s, IntOf<F> marks, Paths<F>& p) {
  const auto marked = [&](std::int32_t value) __attribute__((always_inline)) {
    return bits(equal(marks & IntOf<F>(value), IntOf<F>(value)));
  };
  p.straight = marked(1);
  if (s.has_splitting()) p.branch = marked(8);
  if (s.has_reuse()) p.first = marked(2), p.second = marked(4);
}

/// Calls number(row, x) or integer(row, x) for each member of the paths that differs between waiting paths. row: its
/// column in the pool. Members that the scene does not use are left out.
template <class F>
TYNDALL_INLINE void each_part(const auto& s, Paths<F>& p, const auto& number, const auto& integer) {
  IntOf<F> low = as_int(p.sampler.low), high = as_int(p.sampler.high);
  integer(0, low), integer(1, high), integer(2, p.slot), integer(3, p.depth), integer(4, p.ray.from);
  p.sampler.low = as_uint(low), p.sampler.high = as_uint(high);
  number(0, p.ray.origin.x), number(1, p.ray.origin.y), number(2, p.ray.origin.z);
  number(3, p.ray.direction.x), number(4, p.ray.direction.y), number(5, p.ray.direction.z);
  number(6, p.ray.time), number(7, p.pdf);
  number(8, p.throughput.x), number(9, p.throughput.y), number(10, p.throughput.z);
  number(11, p.radiance.x), number(12, p.radiance.y), number(13, p.radiance.z);
  if (s.has_specular_paths()) {
    number(14, p.trail.start.x), number(15, p.trail.start.y), number(16, p.trail.start.z);
    number(17, p.trail.pdf);
    integer(5, p.trail.met.packed), integer(6, p.route.packed);
  }
  if (has_sample_weights(s)) number(18, p.weight);
  if (s.has_lights_in_media()) {
    MediumFlight<F>& f = p.flight;
    number(19, f.origin.x), number(20, f.origin.y), number(21, f.origin.z);
    number(22, f.direction.x), number(23, f.direction.y), number(24, f.direction.z);
    number(25, f.begin), number(26, f.end), number(27, f.distance), number(28, f.pdf);
    integer(7, f.medium);
  }
  if (s.has_guide()) {
    GuideTrail<F>& g = p.guide;
    number(29, g.start.x), number(30, g.start.y), number(31, g.start.z);
    number(32, g.direction.x), number(33, g.direction.y), number(34, g.direction.z), number(35, g.pdf);
    integer(9, g.events.low), integer(10, g.events.high);
  }
  if (s.has_reuse() || s.has_lights() || s.has_splitting()) {
    IntOf<F> marks = marks_of(s, p);
    integer(8, marks);
    set_marks(s, marks, p);
  }
}

/// Adds the paths in `lanes` to the pool.
template <class F>
TYNDALL_INLINE void put_to_wait(const auto& s, Paths<F>& p, MaskOf<F> lanes, auto& pool) {
  if constexpr (!Plain<F>)
    append_lanes<F>(s, p, lanes, pool);
  else if (lanes)
    pool.path[pool.count++] = p;
}

/// Starts the next samples, one in each lane.
template <class F>
TYNDALL_INLINE void begin_samples(const auto& s, Paths<F>& p, auto& samples) {
  const NewSamples<F> fresh = take_samples<F>(samples, s);
  p.ray = fresh.ray, p.slot = fresh.slot;
  p.sampler.low = fresh.low, p.sampler.high = fresh.high;
  p.sampler.event = UintOf<F>(dimension::camera_count * golden_ratio);
  p.throughput = Vec3<F>{F(1.0f), F(1.0f), F(1.0f)}, p.radiance = zero3<F>();
  p.depth = IntOf<F>(0), p.pdf = F(one_direction);
  if (has_sample_weights(s)) p.weight = fresh.subpixel_lights.weight;
  if (s.has_specular_paths()) p.route = fresh.subpixel_lights.route, p.trail.met.packed = IntOf<F>(-1);
  if (s.has_guide()) p.guide.events = OrderedEvents<F>::unknown();
  p.straight = s.has_lights() || s.has_splitting() ? ~0u : 0u, p.branch = p.first = p.second = 0;
  p.alive = first_lanes(fresh.count);
}

/// At least this many paths take the next step without waiting for more: idle lanes cost less than storing and loading
/// all paths. With 3/4 of the lanes instead of 7/8, media takes 5 % more time, and next-week 2 %.
template <class F>
inline constexpr int enough_lanes = lanes_of<F> - lanes_of<F> / 8;

/// Refills the lanes before the next step if too few paths of the last one survived. If no path is alive afterwards,
/// all samples are done.
template <class F>
TYNDALL_INLINE void take_paths(const auto& s, Paths<F>& p, auto& pool, auto& samples) {
  if constexpr (Plain<F>) {
    if (p.alive) return;
    if (pool.count > 0)
      p = pool.path[--pool.count], p.alive = 1;
    else if (!samples.empty())
      begin_samples(s, p, samples);
  } else if (__builtin_popcount(p.alive) < enough_lanes<F>) {
    put_to_wait(s, p, mask_from_bits<F>(p.alive), pool);
    if (pool.count < lanes_of<F> && !samples.empty()) return begin_samples(s, p, samples);
    // Those that were added last are taken.
    using U = UintOf<F>;
    const int count = pool.count < lanes_of<F> ? pool.count : lanes_of<F>;
    pool.count -= count;
    load_lanes<F>(s, pool, pool.count, p);
    p.sampler.event = (as_uint(p.depth) * U(dimension::per_event) + U(dimension::camera_count)) * U(golden_ratio);
    p.alive = first_lanes(count);
  }
}

}  // namespace tyndall
