#pragma once
#include "app/curves/curve.h"
#include "app/window/system/layout.h"

#include <optional>
#include <span>

/// Where the curves of the live chart are, in window units with y down. No drawing happens here.
namespace tyndall {

inline constexpr double target_rel_mse = 1e-4;  ///< of 1 % relative error

/// Whole decades of an axis pair: 10^x0 to 10^x1 seconds, 10^y0 to 10^y1 relMSE.
struct Decades {
  int x0 = -1, x1 = 1, y0 = -4, y1 = 0;
};

/// Decades that hold all curves and the target.
Decades decades_of(std::span<const ErrorCurve* const> curves);

/// Logarithmic axes in a rectangle.
struct ChartAxes {
  Decades decades;
  Rect frame;

  float x(double seconds) const;
  float y(double rel_mse) const;
  double seconds(float x) const;
  double rel_mse(float y) const;
};

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
