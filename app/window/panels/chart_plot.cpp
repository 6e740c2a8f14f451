#include "app/window/panels/chart_plot.h"

#include <algorithm>
#include <cmath>

namespace tyndall {

ChartAxes axes_for(std::span<const ErrorCurve* const> curves, const Rect& frame) {
  ChartAxes axes;
  axes.frame = frame;
  double first = 1e300, last = 0, minimum = target_rel_mse, maximum = target_rel_mse;
  for (const ErrorCurve* curve : curves)
    for (const ErrorPoint& p : curve->points) {
      first = std::min(first, p.seconds), last = std::max(last, p.seconds);
      minimum = std::min(minimum, p.rel_mse), maximum = std::max(maximum, p.rel_mse);
    }
  if (last > 0) axes.times = decades_around(std::max(first, 1e-3), last, 2);
  axes.errors = decades_around(std::min(minimum * 0.7, 1e-5), maximum, 3);
  return axes;
}

float ChartAxes::x(double seconds) const {
  return frame.x0 + static_cast<float>(times.part_of(seconds)) * frame.width();
}
float ChartAxes::y(double rel_mse) const {
  return frame.y1 - static_cast<float>(errors.part_of(rel_mse)) * frame.height();
}
double ChartAxes::seconds(float x) const { return times.value_at(static_cast<double>((x - frame.x0) / frame.width())); }
double ChartAxes::rel_mse(float y) const {
  return errors.value_at(static_cast<double>((frame.y1 - y) / frame.height()));
}

std::optional<CurveReading> nearest_curve(std::span<const ErrorCurve* const> curves, const ChartAxes& axes, float x,
                                          float y, float reach) {
  std::optional<CurveReading> nearest;
  float minimum = 0;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const ErrorCurve& curve = *curves[i];
    if (curve.points.empty()) continue;
    const ErrorPoint &first = curve.points.front(), &last = curve.points.back();
    if (x < axes.x(first.seconds) - reach || x > axes.x(last.seconds) + reach) continue;
    const auto at = point_at(curve, std::clamp(axes.seconds(x), first.seconds, last.seconds));
    const float distance = std::abs(axes.y(at->rel_mse) - y);
    if (!nearest || distance < minimum) nearest = CurveReading{i, *at}, minimum = distance;
  }
  return nearest;
}

std::vector<Rect> rows_of_names(std::span<const float> widths, const Rect& first, float gap) {
  std::vector<Rect> rows;
  float x = first.x0, y = first.y0;
  for (const float width : widths) {
    if (x > first.x0 && x + width > first.x1) x = first.x0, y += first.height();
    rows.push_back({x, y, x + width, y + first.height()});
    x += width + gap;
  }
  return rows;
}

}  // namespace tyndall
