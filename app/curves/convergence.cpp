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

std::optional<ConvergencePoint> point_at(const ConvergenceRun& run, double seconds) {
  const auto& points = run.points;
  if (points.empty() || seconds < points.front().seconds || seconds > points.back().seconds) return {};
  const auto after = std::find_if(points.begin(), points.end(), [&](const auto& p) { return p.seconds >= seconds; });
  if (after == points.begin()) return *after;
  const ConvergencePoint &a = after[-1], &b = *after;
  const double part = std::log(seconds / a.seconds) / std::log(b.seconds / a.seconds);
  const auto between = [part](double from, double to) { return from * std::pow(to / from, part); };
  const double spp = between(std::max(1.0, static_cast<double>(a.spp)), std::max(1.0, static_cast<double>(b.spp)));
  return ConvergencePoint{seconds, between(a.rel_mse, b.rel_mse), static_cast<std::uint32_t>(std::lround(spp)),
                          b.noise};
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

std::vector<NamedRun> named_runs(const Convergence& runs, const Convergence* kept) {
  using Role = NamedRun::Role;
  std::vector<NamedRun> named;
  const std::string& now = runs.current().method;
  for (const ConvergenceRun& run : runs.earlier())
    named.push_back({Role::earlier, &run, run.method == now ? now + " before" : run.method});
  if (kept) named.push_back({Role::kept, &kept->current(), "A: " + kept->current().method});
  named.push_back({Role::current, &runs.current(), kept ? "B: " + now : now});
  return named;
}

double seconds_to(double target, const ConvergencePoint& known, double seconds) {
  return std::max(0.0, known.seconds * known.rel_mse / (target * target) - seconds);
}

}  // namespace tyndall
