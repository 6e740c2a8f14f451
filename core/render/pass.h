#pragma once
#include "core/base/crew.h"
#include "core/film/film.h"
#include "core/kernel/kernels.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <vector>

namespace tyndall {

/// One sweep over an image: the same sample indices for every pixel, or for each up to a count of its own; cut into
/// units of about 2,000 paths. A unit is added to the film whole or not at all, so a pixel's samples are always a
/// prefix. A pass that was given up can go on later.
class Pass {
 public:
  /// Samples first … last - 1 of the region's pixels. step, skip_step: see Unit. tile: edge in pixels, 0: chosen.
  Pass(Region region, std::uint32_t first, std::uint32_t last, int step = 1, int skip_step = 0, int tile = 0);

  /// For every pixel of the film's region, row by row, the samples that it lacks of `wanted`.
  Pass(const Film& film, std::vector<std::uint32_t> wanted, int tile = 0);

  /// Runs the units that are left and adds them to `film` (the film's first sample replaces what the pixel held), until
  /// all are done or `give_up` is set: then within one unit. Answers whether all are done. poll: see Crew::for_each.
  bool run(Crew& crew, const Kernels& kernels, const SceneView& scene, Film& film, const std::atomic<bool>& give_up,
           const std::function<void()>& poll = {});

  std::uint64_t rays() const { return rays_; }
  std::uint64_t shadow_rays() const { return shadow_rays_; }
  /// Paths that the units done so far have followed.
  std::uint64_t paths() const { return paths_; }
  std::uint64_t rejected() const { return rejected_; }
  std::uint64_t truncated() const { return truncated_; }
  std::uint32_t last() const { return last_; }

 private:
  Region tile(int unit) const;
  void run_unit(int unit, const Kernels& kernels, const SceneView& scene, Film& film);
  bool fill_tile(int unit, const Kernels& kernels, const SceneView& scene, Film& film,
                 const std::atomic<bool>& give_up);
  void add_unit(const Region& where, bool replace, const std::vector<FilmPixel>& pixels, Film& film);
  void add_counts(const UnitCounts& counts);

  Region region_;
  std::uint32_t first_ = 0, last_ = 0;
  std::vector<std::uint32_t> wanted_;  ///< counts of the pixels; empty: first_ to last_ for all
  int step_ = 1, skip_step_ = 0, tile_;
  int columns_, rows_;
  std::vector<std::uint8_t> done_;  ///< a flag a unit; each is written by the one thread that runs it
  std::atomic<std::uint64_t> rays_ = 0, shadow_rays_ = 0, paths_ = 0, rejected_ = 0, truncated_ = 0;
  std::atomic<std::int64_t> cut_high_ = 0, cut_low_ = 0;  ///< limbs of what the film does not know yet
};

}  // namespace tyndall
