#pragma once
#include "app/curves/curve.h"
#include "app/window/system/layout.h"

#include <optional>
#include <span>
#include <vector>

/// Where the curves of the live chart are, in window units with y down. No drawing happens here.
namespace tyndall {

inline constexpr double target_rel_mse = 1e-4;  ///< of 1 % relative error

/// The axes of the chart in a rectangle of the window: seconds to the right, relMSE upwards.
struct ChartAxes {
  Decades times{-1, 1}, errors{-4, 0};
  Rect frame;

  float x(double seconds) const;
  float y(double rel_mse) const;
  double seconds(float x) const;
  double rel_mse(float y) const;
};

/// Axes that hold all curves and the target.
ChartAxes axes_for(std::span<const ErrorCurve* const> curves, const Rect& frame);

/// Where names of these widths stand: side by side from the left, `gap` apart, and in further rows beneath. first: the
/// first row; a name that is wider has a row of its own.
std::vector<Rect> rows_of_names(std::span<const float> widths, const Rect& first, float gap);

/// A place on one of the curves.
struct CurveReading {
  std::size_t curve = 0;  ///< its index
  ErrorPoint at;
};

/// The curve that is nearest above or beneath a place, at that time; a curve that ends less than `reach` beside it
/// counts with its end. Nothing where there is none.
std::optional<CurveReading> nearest_curve(std::span<const ErrorCurve* const> curves, const ChartAxes& axes, float x,
                                          float y, float reach);

}  // namespace tyndall
