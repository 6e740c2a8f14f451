#include "core/render/preview.h"

#include <algorithm>
#include <cmath>

namespace tyndall {

double picture_budget(bool only_camera, double since) { return only_camera ? 0.016 : since < 0.3 ? 0.033 : 0.075; }

int preview_step(std::int64_t pixels, double paths_per_second, double budget, int before) {
  if (!(paths_per_second > 0)) return 8;
  const double wanted = std::sqrt(static_cast<double>(pixels) / (paths_per_second * budget));
  // `before` serves wanted steps from before/2 to before; beyond, room on both sides, less on the one that costs time.
  const bool fits = wanted <= 1.1 * before && (before == 1 || wanted > before / 2.0 / 1.4);
  if (before > 0 && fits) return before;
  int step = 1;
  while (step < 8 && step < wanted) step *= 2;
  return step;
}

std::uint32_t pass_samples(std::uint32_t taken, std::int64_t pixels, double paths_per_second, double seconds) {
  const double in_time = paths_per_second * seconds / static_cast<double>(std::max<std::int64_t>(pixels, 1));
  const auto most = static_cast<std::uint32_t>(std::clamp(in_time, 1.0, 64.0));
  return std::clamp(taken, 1u, most);
}

}  // namespace tyndall
