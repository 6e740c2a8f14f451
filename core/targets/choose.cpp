#include "core/targets/kernels.h"

#include <tyndall_targets.h>

namespace tyndall {
namespace {

Kernels kernels_of(Target target) {
  return use_target<TYNDALL_BUILT_TARGETS>(target, [](auto built) {
    if constexpr (built() == Target::scalar) {
      return scalar_kernels();
    } else {
      Kernels kernels = full_kernel(built);
      if constexpr (floats_in(built()) >= 8) add_kernel_sets(built, kernels);
      return kernels;
    }
  });
}

}  // namespace

void Kernels::render_tile(const SceneView& scene, const TileJob& job, double film_quantum, FilmPixel* pixels,
                          TileCounts& counts, EmissionSums* emission) const {
  if (scene.reuses_paths && job.step > 1) {  // the pixels of a coarse pass are too far apart for reuse
    SceneView alone = scene;
    alone.reuses_paths = false;
    return render_tile(alone, job, film_quantum, pixels, counts, emission);
  }
  render[static_cast<int>(set_for(scene))](scene, job, film_quantum, pixels, emission, counts);
}

KernelSet Kernels::set_for(const SceneView& scene) const {
  const bool has_own = render[static_cast<int>(scene.kernel)] != render[static_cast<int>(KernelSet::everything)];
  const bool serves = !scene.reuses_paths || has_reuse_loop(scene.kernel);
  return has_own && serves ? scene.kernel : KernelSet::everything;
}

std::vector<Kernels> available_kernels() {
  std::vector<Kernels> list;
  for (const Target target : available_targets()) list.push_back(kernels_of(target));
  return list;
}

std::optional<Kernels> choose_kernels(std::string_view isa) {
  if (const auto target = find_target(isa)) return kernels_of(*target);
  return std::nullopt;
}

}  // namespace tyndall
