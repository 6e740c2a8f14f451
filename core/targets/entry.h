#pragma once
#include "core/reuse/reuse_tile.h"
#include "core/targets/kernels.h"

/// The kernels' entry points as templates over the number type F. A small .cpp file for each instruction set chooses F
/// and fills a table of Kernels with them.
namespace tyndall {

// These functions are static, so that each file has its own copies: of an ordinary template the linker keeps one copy
// for all files, and a copy with wide instructions would crash older CPUs.

/// See TraceRays.
template <class F>
static void trace_rays(const SceneView& s, const TraceRay* rays, TraceHit* hits, int count, bool brute_force) {
  constexpr int lanes = lanes_of<F>;
  for (int first = 0; first < count; first += lanes) {
    alignas(64) float column[7][lanes] = {};
    alignas(64) std::int32_t from[lanes] = {};
    std::uint32_t active = 0;
    for (int k = 0; k < lanes && first + k < count; ++k) {
      const TraceRay& r = rays[first + k];
      const float values[7] = {r.origin.x, r.origin.y, r.origin.z, r.direction.x, r.direction.y, r.direction.z, r.time};
      for (int c = 0; c < 7; ++c) column[c][k] = values[c];
      from[k] = r.from;
      active |= 1u << k;
    }
    const Ray<F> ray{{load<F>(column[0]), load<F>(column[1]), load<F>(column[2])},
                     {load<F>(column[3]), load<F>(column[4]), load<F>(column[5])},
                     load<F>(column[6]),
                     load<F>(from)};
    const auto mask = mask_from_bits<F>(active);
    const Hit<F> hit = brute_force ? closest_of_all(s, ray, mask) : call_closest(s, ray, mask);
    store(column[0], hit.t);
    store(from, hit.element);
    for (int k = 0; k < lanes && first + k < count; ++k) hits[first + k] = {column[0][k], from[k]};
  }
}

/// See FirstHits.
template <class F>
static void first_hits(const SceneView& s, const Region& region, FirstHit* hits) {
  constexpr int lanes = lanes_of<F>;
  const Pair<F> middle_of_lens{F(0.0f), F(0.0f)};
  const F time = splat<F>(s.camera.shutter_open + 0.5f * s.camera.shutter_length);
  for (int y = region.y0; y < region.y1; ++y)
    for (int x = region.x0; x < region.x1; x += lanes) {
      alignas(64) float column[7][lanes] = {};
      alignas(64) std::int32_t element[lanes];
      for (int k = 0; k < lanes; ++k) column[0][k] = static_cast<float>(x + k) + 0.5f;
      const Ray<F> ray =
          camera_ray(s.camera, load<F>(column[0]), splat<F>(static_cast<float>(y) + 0.5f), middle_of_lens, time);
      const auto everywhere = less(F(0.0f), F(1.0f));
      const Hit<F> hit = call_closest(s, ray, everywhere);
      const auto met = less_equal(IntOf<F>(0), hit.element);
      store(element, hit.element);
      if (any(met)) {
        const SurfacePoint<F> p = surface_at(s, ray, hit.t, hit.element);
        const Vec3<F> colour = surface_colour(s, p, met);
        const F depth = dot(p.point - splat<F>(s.camera.center), splat<F>(s.camera.axis));
        store(column[0], colour.x), store(column[1], colour.y), store(column[2], colour.z);
        store(column[3], p.normal.x), store(column[4], p.normal.y), store(column[5], p.normal.z);
        store(column[6], depth);
      }
      for (int k = 0; k < lanes && x + k < region.x1; ++k) {
        FirstHit& h = *hits++;
        h = {};
        h.element = element[k];
        if (h.element < 0) continue;
        h.depth = column[6][k];
        h.albedo = {column[0][k], column[1][k], column[2][k]};
        h.normal = {column[3][k], column[4][k], column[5][k]};
      }
    }
}

/// Samples of either kind, for the kernel with every model, which renders scenes with and without reuse by one path
/// loop: a loop for each would take twice as long to compile. It holds the samples of paths that share nothing, which
/// makes them as quick as in a loop of their own but for a few percent.
class EitherSamples {
 public:
  /// groups: null, or what is taken in place of the tile job's samples.
  TYNDALL_INLINE EitherSamples(const SceneView& s, const TileJob& job, const TileFilm& film, GroupSamples* groups)
      : alone_(s, groups ? TileJob{} : job, film), groups_(groups) {}
  TYNDALL_INLINE bool empty() const { return groups_ ? groups_->empty() : alone_.empty(); }
  TYNDALL_INLINE const SubpixelLights& subpixel_lights() const {
    return groups_ ? groups_->subpixel_lights() : alone_.subpixel_lights();
  }
  template <int lanes>
  TYNDALL_INLINE void take(CameraSamples<lanes>& to) {
    groups_ ? groups_->take(to) : alone_.take(to);
  }
  template <class F>
  TYNDALL_INLINE void on_event(const auto& s, Paths<F>& p, const Event<F>& e, MaskOf<F> met) {
    if (groups_) groups_->on_event(s, p, e, met);
  }
  template <class F>
  TYNDALL_INLINE MaskOf<F> on_scatter(const auto& s, Paths<F>& p, const Event<F>& e, MaskOf<F> scattering) {
    return groups_ ? groups_->on_scatter(s, p, e, scattering) : alone_.on_scatter(s, p, e, scattering);
  }
  template <class F>
  TYNDALL_INLINE IntOf<F> slot_of(const Paths<F>& p) const {
    return groups_ ? groups_->slot_of(p) : alone_.slot_of(p);
  }
  template <class F>
  TYNDALL_INLINE void on_end(const auto& s, const Paths<F>& p, std::uint32_t ended, std::uint32_t cut) {
    groups_ ? groups_->on_end(s, p, ended, cut) : alone_.on_end(s, p, ended, cut);
  }
  TYNDALL_INLINE void add(std::int32_t slot, Vec3f light) {
    groups_ ? groups_->add(slot, light) : alone_.add(slot, light);
  }

 private:
  AloneSamples alone_;
  GroupSamples* groups_;
};

template <class F>
[[gnu::noinline]] static void follow_either(const auto& s, const TileJob& job, const TileFilm& film,
                                            GroupSamples* groups, auto& recorder) {
  EitherSamples samples(s, job, film, groups);
  follow_paths<F>(s, samples, film.counts, recorder);
}

/// Renders a tile job by a path loop for scenes with and without reuse. on_groups(groups): called before each group of
/// pixels that share second vertices.
template <class F>
static void render_either_tile(const auto& s, const TileJob& job, const TileFilm& film, auto& recorder,
                               const auto& on_groups) {
  if (!s.reuses_paths) return follow_either<F>(s, job, film, nullptr, recorder);
  render_tile_reusing<F>(s, job, film, [&](GroupSamples& groups) {
    on_groups(groups);
    follow_either<F>(s, job, film, &groups, recorder);
  });
}

/// Renders a tile job by a path loop for scenes of one kind of Reuse. Each loop is a function of its own: together in
/// one, both would be up to a sixth slower.
template <class F, KernelSet set, Reuse reuse>
[[gnu::noinline]] static void render_tile_of(const SceneView& scene, const TileJob& job, const TileFilm& film) {
  const auto& s = view_for<set, reuse>(scene);
  NoRecorder recorder;
  const auto follow = [&](auto& samples) __attribute__((always_inline)) {
    follow_paths<F>(s, samples, film.counts, recorder);
  };
  if constexpr (reuse == Reuse::always) {
    render_tile_reusing<F>(s, job, film, follow);
  } else {
    AloneSamples samples(s, job, film);
    follow(samples);
  }
}

// The functions in the table of an instruction set.
template <class F, KernelSet set>
static void render_tile_entry(const SceneView& scene, const TileJob& job, double film_quantum, FilmPixel* pixels,
                              EmissionSums* emission, TileCounts& counts) {
  const TileFilm film{1 / film_quantum, pixels, emission, counts};
  // The question which samples they are would cost cheap scenes up to a seventh of their time.
  if constexpr (has_reuse_loop(set))
    if (scene.reuses_paths) return render_tile_of<F, set, Reuse::always>(scene, job, film);
  render_tile_of<F, set, Reuse::never>(scene, job, film);
}
template <class F, class Recorder>
static void render_any_entry(const SceneView& s, const TileJob& job, double film_quantum, FilmPixel* pixels,
                             EmissionSums* emission, TileCounts& counts) {
  Recorder recorder{};
  render_either_tile<F>(s, job, {1 / film_quantum, pixels, emission, counts}, recorder, [](const GroupSamples&) {});
}
/// A table in which one kernel with every model serves all KernelSets. It gives the same pictures, a little slower, and
/// compiles much sooner: for references and for old processors.
template <class F, class Recorder = NoRecorder>
static Kernels full_kernel_of(const char* isa) {
  const RenderTile render = render_any_entry<F, Recorder>;
  return {isa, lanes_of<F>, {render, render, render, render, render, render}, trace_rays<F>, first_hits<F>};
}

}  // namespace tyndall
