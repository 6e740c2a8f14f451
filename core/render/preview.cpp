#include "core/render/preview.h"

#include <algorithm>
#include <cmath>

namespace tyndall {

double picture_budget(bool only_camera, double since) { return only_camera ? 0.016 : since < 0.3 ? 0.033 : 0.075; }

int preview_step(std::int64_t pixels, double paths_per_second, double budget, int before) {
  constexpr int maximum = 8;
  if (!(paths_per_second > 0)) return maximum;
  const double wanted = std::sqrt(static_cast<double>(pixels) / (paths_per_second * budget));
  const auto step_of = [](double ideal) {
    return static_cast<int>(std::ceil(std::clamp(ideal, 1.0, static_cast<double>(maximum))));
  };
  if (before < 1 || wanted > 1.1 * before) return step_of(wanted);
  return std::min(before, step_of(1.25 * wanted));
}

int step_of_shown(std::int64_t pixels, std::int64_t shown) {
  if (shown <= 0) return 1;
  return static_cast<int>(
      std::ceil(std::clamp(std::sqrt(static_cast<double>(pixels) / static_cast<double>(shown)), 1.0, 8.0)));
}

int coarse_clean_step(std::int64_t pixels, double paths_per_second, double filter_seconds) {
  constexpr double budget = 0.1, soon = 0.04, maximum = 8;
  if (!(paths_per_second > 0)) return static_cast<int>(maximum);
  const double whole = static_cast<double>(pixels) * (2 / paths_per_second + filter_seconds);
  return whole <= soon ? 1 : static_cast<int>(std::ceil(std::clamp(std::sqrt(whole / budget), 2.0, maximum)));
}

int FirstPictures::step_for(std::int64_t pixels, double budget, std::int64_t shown) {
  // Drawing and showing count, but are allowed at most three quarters of the time for samples.
  const double left = std::min(budget, 1.6 * budget - showing_seconds_) - drawing_seconds_;
  step_ = preview_step(pixels, paths_per_second_, std::max(left, budget / 4), step_);
  return std::max(step_, step_of_shown(pixels, shown));
}

void FirstPictures::note_showing(double seconds) {
  showing_seconds_ = showing_seconds_ > 0 ? std::sqrt(showing_seconds_ * seconds) : seconds;
}

void FirstPictures::note_pass(double paths_per_second) {
  // The geometric mean with the earlier value evens out single slow passes.
  paths_per_second_ = paths_per_second_ > 0 ? std::sqrt(paths_per_second_ * paths_per_second) : paths_per_second;
}

}  // namespace tyndall
