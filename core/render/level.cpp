#include "core/render/level.h"

#include "core/render/pass.h"

#include <vector>

namespace tyndall {

void level(Crew& crew, const Kernels& kernels, const SceneView& scene, Film& film, const std::atomic<bool>& give_up,
           UnitCounts& counts, const std::function<void()>& poll) {
  const FilmTotals sum = totals(film);
  if (sum.least_taken == sum.most_taken) return;
  Pass pass(film, std::vector<std::uint32_t>(film.pixels.size(), sum.most_taken));
  pass.run(crew, kernels, scene, film, give_up, poll);
  counts.rays += pass.rays();
  counts.shadow_rays += pass.shadow_rays();
}

}  // namespace tyndall
