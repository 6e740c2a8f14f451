#include "app/window/panels/chart_plot.h"

#include <algorithm>
#include <cmath>

namespace tyndall {

Decades decades_of(std::span<const ErrorCurve* const> curves) {
  Decades d;
  double first = 1e300, last = 0, least = target_rel_mse, most = target_rel_mse;
  for (const ErrorCurve* curve : curves)
    for (const ErrorPoint& p : curve->points) {
      first = std::min(first, p.seconds), last = std::max(last, p.seconds);
      least = std::min(least, p.rel_mse), most = std::max(most, p.rel_mse);
    }
  const auto below = [](double v) { return static_cast<int>(std::floor(std::log10(v))); };
  const auto above_of = [](double v) { return static_cast<int>(std::ceil(std::log10(v))); };
  if (last > 0) d.x0 = std::max(below(first), -3), d.x1 = std::max(above_of(last), d.x0 + 2);
  d.y0 = std::min(below(least * 0.7), -5), d.y1 = std::max(above_of(most), d.y0 + 3);
  return d;
}

float ChartAxes::x(double seconds) const {
  const double t = (std::log10(seconds) - decades.x0) / (decades.x1 - decades.x0);
  return frame.x0 + static_cast<float>(t) * frame.width();
}

float ChartAxes::y(double rel_mse) const {
  const double t = (std::log10(rel_mse) - decades.y0) / (decades.y1 - decades.y0);
  return frame.y1 - static_cast<float>(t) * frame.height();
}

double ChartAxes::seconds(float x) const {
  const double t = static_cast<double>((x - frame.x0) / frame.width());
  return std::pow(10.0, decades.x0 + t * (decades.x1 - decades.x0));
}

double ChartAxes::rel_mse(float y) const {
  const double t = static_cast<double>((frame.y1 - y) / frame.height());
  return std::pow(10.0, decades.y0 + t * (decades.y1 - decades.y0));
}

std::optional<CurveReading> nearest_curve(std::span<const ErrorCurve* const> curves, const ChartAxes& axes, float x,
                                          float y, float reach) {
  std::optional<CurveReading> nearest;
  float least = 0;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const ErrorCurve& curve = *curves[i];
    if (curve.points.empty()) continue;
    const ErrorPoint &first = curve.points.front(), &last = curve.points.back();
    if (x < axes.x(first.seconds) - reach || x > axes.x(last.seconds) + reach) continue;
    const auto at = point_at(curve, std::clamp(axes.seconds(x), first.seconds, last.seconds));
    const float distance = std::abs(axes.y(at->rel_mse) - y);
    if (!nearest || distance < least) nearest = CurveReading{i, *at}, least = distance;
  }
  return nearest;
}

}  // namespace tyndall
