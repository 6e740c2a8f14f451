#pragma once
#include "core/scene/scene.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// What the live chart shows: how the estimated error fell with time, for the current edit and a few before it. Pure.
namespace tyndall {

struct ConvergencePoint {
  double seconds = 0;     ///< of rendering since the edit, > 0
  double rel_mse = 0;     ///< the square of the relative error, > 0
  std::uint32_t spp = 0;  ///< samples that every pixel had
  double noise = 0;       ///< the part of rel_mse that is noise, as the picture's halves tell
};

struct ConvergenceRun {
  std::uint64_t edit = 0;
  std::string method;  ///< "mis · sobol"
  std::vector<ConvergencePoint> points;
};

/// "mis · sobol", with "· schlick" where that approximation is on.
std::string method_of(const RenderSettings& settings);
/// The same, with depth and seed where they are not those of the file.
std::string method_of(const RenderSettings& settings, const RenderSettings& file);

/// The curve at that time, between its points on logarithmic scales; nothing before its first and after its last point.
std::optional<ConvergencePoint> point_at(const ConvergenceRun& run, double seconds);

class Convergence {
 public:
  /// Adds a point to the current run. A new edit begins a new one; the old one is kept if it was long enough to say
  /// something. Points closer than 4 % in time to the last one replace it. Errors that are not finite, or that are the
  /// last one's because they were not estimated anew, are left out.
  void add(std::uint64_t edit, const std::string& method, ConvergencePoint point);
  /// Forgets all runs: another scene.
  void clear();

  const ConvergenceRun& current() const { return current_; }
  /// Oldest first, the newest of each method.
  const std::vector<ConvergenceRun>& earlier() const { return earlier_; }

  static constexpr std::size_t most_earlier = 4;
  static constexpr double least_seconds = 0.5;  ///< shorter runs (drags) are not kept

 private:
  void keep_current();

  ConvergenceRun current_;
  std::vector<ConvergenceRun> earlier_;
};

/// A curve and what it is called in the chart and in files.
struct NamedRun {
  enum class Role { earlier, kept, current } role = Role::earlier;
  const ConvergenceRun* run = nullptr;
  std::string name;
};

/// All curves, the current one last. kept: of the other half of a split view, null: there is none.
std::vector<NamedRun> named_runs(const Convergence& runs, const Convergence* kept);

/// Seconds of rendering from `seconds` on until the relative error is `target`, if its square falls as 1/time from
/// what is known; 0 when it is reached.
double seconds_to(double target, const ConvergencePoint& known, double seconds);

}  // namespace tyndall
