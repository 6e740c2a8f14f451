#include "app/window/convergence.h"

#include "core/scene/names.h"

#include <algorithm>
#include <cmath>

namespace tyndall {

std::string method_of(const RenderSettings& settings) {
  std::string method =
      std::string(name_of(integrators, settings.integrator)) + " · " + name_of(samplers, settings.sampler);
  if (settings.fresnel == FresnelKind::schlick) method += " · schlick";
  if (settings.adaptive) method += " · adaptive";
  return method;
}

void Convergence::add(std::uint64_t edit, const std::string& method, ConvergencePoint point) {
  if (edit != current_.edit || (!current_.points.empty() && point.seconds < current_.points.back().seconds)) {
    keep_current();
    current_ = {edit, method, {}};
  }
  const bool good = point.seconds > 0 && point.rel_mse > 0 && std::isfinite(point.rel_mse);
  if (!good) return;
  std::vector<ConvergencePoint>& points = current_.points;
  if (!points.empty() && point.rel_mse == points.back().rel_mse) return;  // not estimated anew
  if (points.size() > 1 && point.seconds < 1.04 * points[points.size() - 2].seconds) points.pop_back();
  points.push_back(point);
}

void Convergence::clear() {
  current_ = {};
  earlier_.clear();
}

void Convergence::keep_current() {
  if (current_.points.size() < 3 || current_.points.back().seconds < least_seconds) return;
  std::erase_if(earlier_, [&](const ConvergenceRun& run) { return run.method == current_.method; });
  earlier_.push_back(std::move(current_));
  if (earlier_.size() > most_earlier) earlier_.erase(earlier_.begin());
}

double seconds_to(double target, const ConvergencePoint& known, double seconds) {
  return std::max(0.0, known.seconds * known.rel_mse / (target * target) - seconds);
}

}  // namespace tyndall
