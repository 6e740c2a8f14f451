#pragma once
#include "core/base/thread_pool.h"
#include "core/film/film.h"
#include "core/render/sample_source.h"
#include "core/targets/kernels.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

/// Takes samples with all threads; an interrupt takes effect within 2 ms and loses no samples.
namespace tyndall {

/// What a pass needs to run: threads, and kernels with the scene that these read, or another source of samples.
struct RenderEngine {
  ThreadPool& thread_pool;
  const Kernels& kernels;
  const SceneView& scene;
  const SampleSource* samples = nullptr;  ///< null: the kernels take them
  /// As soon as it is set, a source of samples leaves its tile job, whose samples are lost. Null: it never does. Where
  /// a pass is only interrupted, it must not be set, or a slow source might never finish a tile job.
  const std::atomic<bool>* leave = nullptr;

  /// See Kernels::render_tile. Returns whether the tile job is whole.
  bool render_tile(const TileJob& job, double film_quantum, FilmPixel* pixels, TileCounts& counts,
                   EmissionSums* emission) const {
    if (samples) return sample_tile(*samples, scene, job, film_quantum, pixels, leave);
    kernels.render_tile(scene, job, film_quantum, pixels, counts, emission);
    return true;
  }
};

/// The kernels of an instruction set; "": the best. Throws std::invalid_argument for one that this build or processor
/// has not.
Kernels kernels_of(const std::string& isa);

/// How a pass is cut into tile jobs.
struct Tiling {
  int edge = 0;               ///< of tiles, in pixels; 0: chosen by the pass
  bool reuses_paths = false;  ///< the scene reuses second vertices: chosen tiles hold whole blocks of pixels
  double paths = 2048;        ///< of a tile job, about
  bool any_edge = false;      ///< chosen tiles may have any number of pixels; else, at least 8 x 8
};

/// One sweep over an image. It takes the same range of sample indices for every pixel, or brings each pixel up to its
/// own count. The work is cut into tile jobs of about 2,000 paths. A tile job is added to the film whole or not at all,
/// so that each pixel always has the first n of its samples, without gaps. An interrupted pass can be continued.
class Pass {
 public:
  /// Samples first … last - 1 of the region's pixels. step, skip_step: see TileJob.
  Pass(Region region, std::uint32_t first, std::uint32_t last, int step = 1, int skip_step = 0, Tiling tiling = {});

  /// Brings each pixel of a part of the film's region to `wanted` samples, which has a number for each pixel of the
  /// region (row by row). Pixels that have more keep them.
  Pass(const Film& film, std::vector<std::uint32_t> wanted, const Region& part, Tiling tiling = {});

  /// Runs the units that are left and adds them to `film`, until all are done or `give_up` is set: then it returns
  /// within one unit. Returns whether all are done. A sample of index film.first_sample replaces what its pixel held,
  /// so that a film can be begun anew without clearing it. poll: see ThreadPool::for_each.
  bool run(const RenderEngine& engine, Film& film, const std::atomic<bool>& give_up,
           const std::function<void()>& poll = {});

  std::uint64_t rays() const { return rays_; }
  std::uint64_t shadow_rays() const { return shadow_rays_; }
  std::uint64_t splits() const { return splits_; }
  /// Paths of the tile jobs done so far.
  std::uint64_t paths() const { return paths_; }
  std::uint64_t rejected() const { return rejected_; }
  std::uint64_t truncated() const { return truncated_; }
  std::uint32_t last() const { return last_; }

 private:
  void cut(Tiling tiling, std::uint32_t samples);
  Region tile(int index) const;
  bool fill_tile(int index, const RenderEngine& engine, Film& film, const std::atomic<bool>& give_up);
  bool run_job(const TileJob& job, const RenderEngine& engine, Film& film);

  Region region_;
  std::uint32_t first_ = 0, last_ = 0;
  std::vector<std::uint32_t> wanted_;  ///< for each pixel; empty: first_ to last_ for all
  int step_ = 1, skip_step_ = 0, tile_;
  double paths_per_tile_ = 0;
  int left_, top_;  ///< of the first tile: at most those of the region
  int columns_, rows_;
  std::vector<std::uint8_t> done_;  ///< for each tile; written only by the thread that runs it
  std::atomic<std::uint64_t> rays_ = 0, shadow_rays_ = 0, splits_ = 0, paths_ = 0, rejected_ = 0, truncated_ = 0;
  std::atomic<std::int64_t> cut_high_ = 0, cut_low_ = 0;  ///< not yet added to film.cut_throughput
};

}  // namespace tyndall
