#pragma once
#include "core/targets/kernels.h"

#include <atomic>

/// For tests of interrupted passes: lets a pass be given up after a chosen number of units of work.
namespace tyndall::test {

struct Stop {
  Kernels real{};
  std::atomic<int> units_left = 0;
  std::atomic<bool> give_up = false;
};
inline Stop stop;

inline void stopping_unit(const SceneView& scene, const Unit& unit, double film_unit, FilmPixel* pixels,
                          EmissionSums* emission, UnitCounts& counts) {
  stop.real.render_unit(scene, unit, film_unit, pixels, counts, emission);
  if (--stop.units_left == 0) stop.give_up = true;
}

}  // namespace tyndall::test
