#include "core/base/target.h"
#include "core/targets/kernels.h"

namespace tyndall {
namespace {

/// The kernels of each target, in the order of Target. Null: this build has no code for the target, and
/// available_targets() does not list it.
constexpr Kernels (*tables[target_count])() = {
    scalar_kernels,
#if defined(TYNDALL_HAVE_SSE4)
    sse4_kernels,
#else
    nullptr,
#endif
#if defined(TYNDALL_HAVE_AVX2)
    avx2_kernels,
#else
    nullptr,
#endif
#if defined(TYNDALL_HAVE_AVX512)
    avx512_kernels,
#else
    nullptr,
#endif
#if defined(TYNDALL_HAVE_NEON)
    neon_kernels,
#else
    nullptr,
#endif
};

Kernels kernels_of(Target target) { return tables[static_cast<int>(target)](); }

}  // namespace

void Kernels::render_tile(const SceneView& scene, const TileJob& job, double film_quantum, FilmPixel* pixels,
                          TileCounts& counts, EmissionSums* emission) const {
  // The pixels of a coarse pass are too far apart for reuse.
  const bool reuses = scene.reuses_paths && job.step == 1;
  const auto& render = reuses ? render_reusing : render_alone;
  render[static_cast<int>(scene.kernel)](scene, job, film_quantum, pixels, emission, counts);
}

KernelSet Kernels::set_for(KernelSet minimum) const {
  const RenderTile full = render_alone[static_cast<int>(KernelSet::everything)];
  return render_alone[static_cast<int>(minimum)] == full ? KernelSet::everything : minimum;
}

std::vector<Kernels> available_kernels() {
  std::vector<Kernels> list;
  for (const Target target : available_targets()) list.push_back(kernels_of(target));
  return list;
}

std::optional<Kernels> choose_kernels(std::string_view isa) {
  if (isa == "double") return double_kernels();
  if (const auto target = find_target(isa)) return kernels_of(*target);
  return std::nullopt;
}

}  // namespace tyndall
