#pragma once
#include "core/scene/scene.h"

#include <algorithm>
#include <cmath>
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
inline double seconds_left(double target, const ErrorPoint& known, double seconds) {
  return std::max(0.0, known.seconds * known.rel_mse / (target * target) - seconds);
}

/// How many times less time a curve takes than the first one to reach the lowest error that both reach; nothing if
/// there is no such error. Another error can give another answer: for example, Sobol' points gain more on random
/// numbers the lower the error is.
std::optional<double> speed_against(const ErrorCurve& first, const ErrorCurve& curve);

/// Errors below this one would be mostly the reference's own noise. reference_noise: relMSE of the reference; 0: not
/// known.
inline double min_measurable(double reference_noise) { return 4 * reference_noise; }

/// The error that stays although the samples double: what noise does not explain in the last points. Nothing where it
/// cannot be told from noise, the picture's or the reference's.
std::optional<double> bias_of(const ErrorCurve& curve, double reference_noise);

/// An axis from 10^first to 10^last.
struct Decades {
  int first = 0, last = 1;

  /// Where a value > 0 is on the axis: 0 at its beginning, 1 at its end.
  double part_of(double value) const { return (std::log10(value) - first) / (last - first); }
  /// The value at that part of the axis.
  double value_at(double part) const { return std::pow(10.0, first + part * (last - first)); }
  double minimum() const { return std::pow(10.0, first); }
  double maximum() const { return std::pow(10.0, last); }
};

/// The whole decades that hold all values from `minimum` > 0 to `maximum`, and at least `count` >= 1 of them.
inline Decades decades_around(double minimum, double maximum, int count) {
  const int first = static_cast<int>(std::floor(std::log10(minimum)));
  return {first, std::max(static_cast<int>(std::ceil(std::log10(maximum))), first + count)};
}

/// "mis · sobol", with "· schlick" where that approximation is on, and depth and seed where they are not those of the
/// file.
std::string method_of(const RenderSettings& settings, const RenderSettings& file);

/// The curve of the newest edit while it grows, and those of earlier edits that are worth a comparison.
class Convergence {
 public:
  /// Adds a point to the current curve. A new edit, or a time before the last point's, begins a new curve; the old one
  /// is kept if it is long enough to tell something. A point less than 4 % later than the last but one replaces the
  /// last one. Points are left out if their error is not finite and positive, or equal to that of the last
  /// one, because then it was not estimated anew.
  void add(std::uint64_t edit, const std::string& method, ErrorPoint point);
  /// Forgets all curves: another scene was opened.
  void clear() { *this = {}; }

  const ErrorCurve& current() const { return current_; }
  /// Of each method only the newest, in the place of the one before it, so that a method keeps its colour in the chart.
  const std::vector<ErrorCurve>& earlier() const { return earlier_; }

  static constexpr std::size_t max_earlier = 4;
  static constexpr double min_seconds = 0.5;  ///< curves over less time, as during a drag, are not kept

 private:
  void keep_current();

  ErrorCurve current_;
  std::vector<ErrorCurve> earlier_;
};

/// A curve and what it is called in the chart and in files.
struct NamedCurve {
  enum class Role { earlier, kept, clean, current } role = Role::earlier;
  const ErrorCurve* curve = nullptr;
  std::string name;
};

/// All curves, the current one last. kept: of the other half of a split view; clean: of the clean view of the current
/// picture; null: there is none.
std::vector<NamedCurve> named_curves(const Convergence& curves, const Convergence* kept,
                                     const Convergence* clean = nullptr);

}  // namespace tyndall
