#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// This room knows how the error of a growing picture falls with time. The command `chart` and the window's live chart
/// share one kind of point, one kind of curve and one way to read between points. Times are seconds of rendering, and
/// errors are relMSE, the square of the relative error.
namespace tyndall {

/// The error of a picture at one moment.
struct ErrorPoint {
  double seconds = 0;     ///< of rendering, > 0
  double rel_mse = 0;     ///< estimated, or against a reference whose own noise is taken off (then it may be <= 0)
  std::uint32_t spp = 0;  ///< samples that every pixel had
  double noise = 0;       ///< the part of rel_mse that is noise, from the two halves of each pixel; infinite at 1 spp
};

/// The error of one way of rendering over time.
struct ErrorCurve {
  std::string method;              ///< "mis · sobol"
  std::vector<ErrorPoint> points;  ///< seconds and spp grow
  std::uint64_t edit = 0;          ///< in the window: number of the edit whose picture this is
};

/// The point of the curve at that time, read between its points on logarithmic scales. Nothing before the curve's first
/// and after its last point.
std::optional<ErrorPoint> point_at(const ErrorCurve& curve, double seconds);

/// The time at which the curve first reaches an error > 0, read between its points on logarithmic scales. Nothing if it
/// never does.
std::optional<double> seconds_to(const ErrorCurve& curve, double rel_mse);

/// How many seconds more to render, `seconds` having passed, until the relative error (the root of relMSE) is `target`,
/// if relMSE goes on falling as 1/time from a known point. 0 when it should be there already.
double seconds_left(double target, const ErrorPoint& known, double seconds);

/// How many times less time a curve takes than the first one to reach the lowest error that both reach; nothing if
/// there is no such error. Another error can give another answer: for example, Sobol' points gain more on random
/// numbers the lower the error is.
std::optional<double> speed_against(const ErrorCurve& first, const ErrorCurve& curve);

/// Errors below this one would be mostly the reference's own noise. reference_noise: relMSE of the reference; 0: not
/// known.
double min_measurable(double reference_noise);

/// The error that stays although the samples double: what noise does not explain in the last points. Nothing where it
/// cannot be told from noise, the picture's or the reference's.
std::optional<double> bias_of(const ErrorCurve& curve, double reference_noise);

}  // namespace tyndall
