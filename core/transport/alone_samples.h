#pragma once
#include "core/film/film.h"
#include "core/trace/tile_job.h"
#include "core/transport/event.h"

/// The samples of a tile job in kernels whose paths share no vertices, and where their light goes.
namespace tyndall {

/// Where the light of a tile job's samples goes.
struct TileFilm {
  double per_quantum;
  FilmPixel* pixels;
  EmissionSums* emission;  ///< null: not recorded
  TileCounts& counts;
};

/// The samples of a tile job, each of which is a path of its own. The path loop takes samples from it and gives it
/// their light; core/reuse has the counterpart for paths that share vertices.
struct AloneSamples {
  TileSamples list;
  TileFilm film;

  TYNDALL_INLINE AloneSamples(const SceneView& s, const TileJob& job, const TileFilm& to) : film(to) {
    list_samples(s, job, list);
  }
  TYNDALL_INLINE bool empty() const { return list.empty(); }
  TYNDALL_INLINE const SubpixelLights& subpixel_lights() const { return list.subpixel_lights; }
  template <int lanes>
  TYNDALL_INLINE void take(CameraSamples<lanes>& to) {
    list.take(to);
  }

  /// Called at each event in the lanes `met`, before the path scatters.
  template <class F>
  TYNDALL_INLINE void on_event(const auto&, Paths<F>&, const Event<F>&, MaskOf<F>) {}
  /// Called before light is sampled, in lanes whose path goes on. Returns the lanes that are exempt from roulette.
  template <class F>
  TYNDALL_INLINE MaskOf<F> on_scatter(const auto&, Paths<F>&, const Event<F>&, MaskOf<F>) {
    return less(F(1.0f), F(0.0f));
  }
  /// Slot for add() of light that reaches this path by another route than the path itself: specular paths.
  template <class F>
  TYNDALL_INLINE IntOf<F> slot_of(const Paths<F>& p) const {
    return p.slot;
  }

  /// Adds the samples of the lanes `ended` to the tile job's pixels. cut: those of them that max_depth ended.
  template <class F>
  TYNDALL_INLINE void on_end(const auto& s, const Paths<F>& p, std::uint32_t ended, std::uint32_t cut) {
    if (!ended) return;
    alignas(64) float r[lanes_of<F>], g[lanes_of<F>], b[lanes_of<F>], carried[lanes_of<F>];
    alignas(64) std::int32_t slot[lanes_of<F>];
    const Vec3<F> sample = weighed(s, p, p.radiance);
    const F left = max_component(p.throughput);
    store(r, sample.x), store(g, sample.y), store(b, sample.z), store(slot, p.slot);
    store(carried, has_sample_weights(s) ? p.weight * left : left);
    const std::uint32_t straight = film.emission ? p.straight : 0;
    const std::uint32_t unusual = ~bits(fits_film(sample, film.per_quantum)) | straight | cut;
    for (; ended; ended &= ended - 1) {
      const int lane = __builtin_ctz(ended);
      FilmPixel& pixel = film.pixels[slot[lane] >> 1];
      const std::uint32_t half = static_cast<std::uint32_t>(slot[lane]) & 1u;
      const Vec3f radiance{r[lane], g[lane], b[lane]};
      pixel.taken += ~p.branch >> lane & 1u;
      if (!(unusual >> lane & 1u)) {
        const ScaledSample add = scaled(radiance, film.per_quantum);
        add_each(pixel.sum[half], add.x, add.y, add.z);
        continue;
      }
      add_sample(pixel, half, radiance, film.per_quantum);
      if (straight >> lane & 1u) add_emission(film.emission[slot[lane] >> 1], half, radiance, film.per_quantum);
      if (!(cut >> lane & 1u)) continue;
      ++pixel.truncated;
      film.counts.cut_throughput.add(static_cast<double>(carried[lane]));
    }
  }

  /// The lanes whose samples a film accepts: ScaledSample::fits(), in lanes. A quantum is a power of two, so that the
  /// limit is a float without rounding, or infinite where every finite number is below it.
  template <class F>
  TYNDALL_INLINE static MaskOf<F> fits_film(const Vec3<F>& sample, double per_quantum) {
    const F limit = splat<F>(static_cast<float>(sample_limit / per_quantum));
    return mask_and(less(abs(sample.x), limit), mask_and(less(abs(sample.y), limit), less(abs(sample.z), limit)));
  }
  TYNDALL_INLINE void add(std::int32_t slot, Vec3f light) {
    add_sample(film.pixels[slot >> 1], static_cast<std::uint32_t>(slot) & 1u, light, film.per_quantum);
  }
};

}  // namespace tyndall
