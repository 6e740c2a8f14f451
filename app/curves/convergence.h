#pragma once
#include "app/curves/curve.h"
#include "core/scene/scene.h"

#include <cstdint>
#include <string>
#include <vector>

/// What the window's live chart shows: how the error fell with time for the current edit and for a few before it.
namespace tyndall {

/// "mis · sobol", with "· schlick" where that approximation is on.
std::string method_of(const RenderSettings& settings);
/// The same, with depth and seed where they are not those of the file.
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
  void clear();

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

/// Copies under the names that the chart shows, for its files. Curves without points are left out.
std::vector<ErrorCurve> copies_of(const std::vector<NamedCurve>& named);

}  // namespace tyndall
