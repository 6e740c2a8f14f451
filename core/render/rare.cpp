#include "core/render/rare.h"

namespace tyndall {

bool has_rare_bright_paths(const ErrorEstimate& estimate, std::uint32_t spp, double chance) {
  if (spp < least_rare_spp) return false;
  // From half a path a pixel on that meets the light the estimate was within a fifth of the error.
  return chance * spp < 0.5 || estimate.rests_on_few_pixels;
}

}  // namespace tyndall
