#include "app/curves/convergence.h"

#include <algorithm>
#include <cmath>

namespace tyndall {

std::string method_of(const RenderSettings& settings) {
  std::string method = std::string(name_of(settings.integrator)) + " · " + name_of(settings.sampler);
  const RenderSettings usual{settings.max_depth, settings.spp, settings.integrator, settings.sampler};
  const auto add = [&]<class T>(const Field<RenderSettings, T>& field) {
    const T& value = settings.*field.value;
    if (value == usual.*field.value) return;
    if constexpr (NamedEnum<T>) method += std::string(" · ") + name_of(value);
    if constexpr (std::is_same_v<T, bool>) method += std::string(value ? " · " : " · no ") + field.name;
  };
  std::apply([&](const auto&... field) { (add(field), ...); }, fields_of<RenderSettings>());
  return method;
}

std::string method_of(const RenderSettings& settings, const RenderSettings& file) {
  std::string method = method_of(settings);
  if (settings.max_depth != file.max_depth) method += " · depth " + std::to_string(settings.max_depth);
  if (settings.seed != file.seed) method += " · seed " + std::to_string(settings.seed);
  return method;
}

void Convergence::add(std::uint64_t edit, const std::string& method, ErrorPoint point) {
  const ErrorPoint* last = current_.points.empty() ? nullptr : &current_.points.back();
  if (edit == current_.edit && last && point.rel_mse == last->rel_mse) return;  // not estimated anew
  if (edit != current_.edit || (last && point.seconds < last->seconds)) {
    keep_current();
    current_ = {method, {}, edit};
  }
  const bool good = point.seconds > 0 && point.rel_mse > 0 && std::isfinite(point.rel_mse);
  if (!good) return;
  std::vector<ErrorPoint>& points = current_.points;
  if (points.size() > 1 && point.seconds < 1.04 * points[points.size() - 2].seconds) points.pop_back();
  points.push_back(point);
}

void Convergence::clear() {
  current_ = {};
  earlier_.clear();
}

void Convergence::keep_current() {
  if (current_.points.size() < 3 || current_.points.back().seconds < min_seconds) return;
  const auto same = std::ranges::find(earlier_, current_.method, &ErrorCurve::method);
  if (same != earlier_.end())
    *same = std::move(current_);
  else
    earlier_.push_back(std::move(current_));
  if (earlier_.size() > max_earlier) earlier_.erase(earlier_.begin());
}

std::vector<NamedCurve> named_curves(const Convergence& curves, const Convergence* kept, const Convergence* clean) {
  using Role = NamedCurve::Role;
  std::vector<NamedCurve> named;
  const std::string& now = curves.current().method;
  for (const ErrorCurve& curve : curves.earlier())
    named.push_back({Role::earlier, &curve, curve.method == now ? now + " before" : curve.method});
  if (kept) named.push_back({Role::kept, &kept->current(), "A: " + kept->current().method});
  if (clean && !clean->current().points.empty())
    named.push_back({Role::clean, &clean->current(), (kept ? "B: " : "") + clean->current().method});
  named.push_back({Role::current, &curves.current(), kept ? "B: " + now : now});
  return named;
}

std::vector<ErrorCurve> copies_of(const std::vector<NamedCurve>& named) {
  std::vector<ErrorCurve> copies;
  for (const NamedCurve& one : named)
    if (!one.curve->points.empty()) copies.push_back({one.name, one.curve->points, one.curve->edit});
  return copies;
}

}  // namespace tyndall
