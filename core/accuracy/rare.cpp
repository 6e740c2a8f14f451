#include "core/accuracy/rare.h"

namespace tyndall {

bool has_rare_bright_paths(const ErrorEstimate& estimate, std::uint32_t spp, double chance) {
  if (spp < min_rare_spp) return false;
  // chance · spp: mean number of paths a pixel that have met such light. Measured: from half a path on, the estimate is
  // within a fifth of the true error.
  return chance * spp < 0.5 || estimate.rests_on_few_pixels;
}

}  // namespace tyndall
