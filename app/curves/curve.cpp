#include "app/curves/curve.h"

namespace tyndall {
namespace {

/// How far `value` lies on the way from a to b on a logarithmic scale: 0 at a, 1 at b.
double part_between(double a, double b, double value) { return std::log(value / a) / std::log(b / a); }

/// The value at that part of the way from a to b on a logarithmic scale.
double value_between(double a, double b, double part) { return a * std::pow(b / a, part); }

}  // namespace

std::optional<ErrorPoint> point_at(const ErrorCurve& curve, double seconds) {
  const std::vector<ErrorPoint>& points = curve.points;
  if (points.empty() || seconds < points.front().seconds || seconds > points.back().seconds) return {};
  const auto after = std::find_if(points.begin(), points.end(), [&](const auto& p) { return p.seconds >= seconds; });
  if (after == points.begin()) return *after;
  const ErrorPoint &a = after[-1], &b = *after;
  const double part = part_between(a.seconds, b.seconds, seconds);
  const double spp = value_between(std::max(1u, a.spp), std::max(1u, b.spp), part);
  return ErrorPoint{seconds, value_between(a.rel_mse, b.rel_mse, part), static_cast<std::uint32_t>(std::lround(spp)),
                    b.noise};
}

std::optional<double> seconds_to(const ErrorCurve& curve, double rel_mse) {
  const std::vector<ErrorPoint>& points = curve.points;
  const auto reached = std::find_if(points.begin(), points.end(), [&](const auto& p) { return p.rel_mse <= rel_mse; });
  if (reached == points.end()) return {};
  // Zero and less, from a reference noisier than the picture, has no place on a logarithmic scale.
  if (reached == points.begin() || !(reached->rel_mse > 0)) return reached->seconds;
  const ErrorPoint &a = reached[-1], &b = *reached;
  return value_between(a.seconds, b.seconds, part_between(a.rel_mse, b.rel_mse, rel_mse));
}

std::optional<double> speed_against(const ErrorCurve& first, const ErrorCurve& curve) {
  if (first.points.empty() || curve.points.empty()) return {};
  const double error = std::max(first.points.back().rel_mse, curve.points.back().rel_mse);
  const auto slow = seconds_to(first, error), fast = seconds_to(curve, error);
  if (!(error > 0) || !slow || !fast) return {};
  return *slow / *fast;
}

std::optional<double> bias_of(const ErrorCurve& curve, double reference_noise) {
  if (curve.points.size() < 4) return {};
  const ErrorPoint& last = curve.points.back();
  const auto before = std::find_if(curve.points.rbegin(), curve.points.rend(),
                                   [&](const ErrorPoint& p) { return 2 * p.spp <= last.spp; });
  if (before == curve.points.rend()) return {};
  const auto rest = [](const ErrorPoint& p) { return p.rel_mse - p.noise; };
  // Bias stays when the samples double. What the estimate of noise misses of heavy tails does not: it falls.
  const double bias = rest(last);
  const bool stays = bias > 0.7 * rest(*before) && bias > 0.5 * last.noise;
  return stays && bias > min_measurable(reference_noise) ? std::optional(bias) : std::nullopt;
}

std::string method_of(const RenderSettings& settings, const RenderSettings& file) {
  std::string method = std::string(name_of(settings.integrator)) + " · " + name_of(settings.sampler);
  const RenderSettings usual{settings.max_depth, settings.spp, settings.integrator, settings.sampler};
  const auto add = [&]<class T>(const Field<RenderSettings, T>& field) {
    const T& value = settings.*field.value;
    if (value == usual.*field.value) return;
    if constexpr (NamedEnum<T>) method += std::string(" · ") + name_of(value);
    if constexpr (std::is_same_v<T, bool>) method += std::string(value ? " · " : " · no ") + field.name;
  };
  std::apply([&](const auto&... field) { (add(field), ...); }, fields_of<RenderSettings>());
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
  if (!(point.seconds > 0 && point.rel_mse > 0 && std::isfinite(point.rel_mse))) return;
  std::vector<ErrorPoint>& points = current_.points;
  if (points.size() > 1 && point.seconds < 1.04 * points[points.size() - 2].seconds) points.pop_back();
  points.push_back(point);
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

}  // namespace tyndall
