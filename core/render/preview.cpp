#include "core/render/preview.h"

#include <algorithm>
#include <cmath>

namespace tyndall {

double picture_budget(bool only_camera, double since) { return only_camera ? 0.016 : since < 0.3 ? 0.033 : 0.075; }

int preview_step(std::int64_t pixels, double paths_per_second, double budget, int before) {
  if (!(paths_per_second > 0)) return 8;
  const double wanted = std::sqrt(static_cast<double>(pixels) / (paths_per_second * budget));
  // The last step fits if the ideal step lies between its half and itself. It is also kept a little beyond these
  // limits, so that the sharpness does not flicker: up to a factor of 1.1 where keeping it makes the picture late, and
  // up to 1.4 where it only makes the picture coarser than necessary.
  const bool fits = wanted <= 1.1 * before && (before == 1 || wanted > before / 2.0 / 1.4);
  if (before > 0 && fits) return before;
  int step = 1;
  while (step < 8 && step < wanted) step *= 2;
  return step;
}

int FirstPictures::step_for(std::int64_t pixels, double budget) {
  // Drawing counts against the budget, but never takes more than three quarters of it from the samples.
  step_ = preview_step(pixels, paths_per_second_, std::max(budget - drawing_seconds_, budget / 4), step_);
  return step_;
}

void FirstPictures::note_pass(double paths_per_second) {
  // The geometric mean with what was known evens out single slow passes.
  paths_per_second_ = paths_per_second_ > 0 ? std::sqrt(paths_per_second_ * paths_per_second) : paths_per_second;
}

}  // namespace tyndall
