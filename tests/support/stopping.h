#pragma once
#include "core/targets/kernels.h"

#include <atomic>

/// For tests of interrupted passes: lets a pass be given up after a chosen number of tile jobs.
namespace tyndall::test {

struct Stop {
  Kernels real{};
  std::atomic<int> tiles_left = 0;
  std::atomic<bool> give_up = false;
};
inline Stop stop;

inline void stopping_tile(const SceneView& scene, const TileJob& job, double film_quantum, FilmPixel* pixels,
                          EmissionSums* emission, TileCounts& counts) {
  stop.real.render_tile(scene, job, film_quantum, pixels, counts, emission);
  if (--stop.tiles_left == 0) stop.give_up = true;
}

}  // namespace tyndall::test
