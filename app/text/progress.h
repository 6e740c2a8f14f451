#pragma once
#include "core/render/render.h"

#include <cstdint>
#include <limits>
#include <string>

/// How a render is going, on standard error.
namespace tyndall {

enum class ProgressStyle { automatic, plain, none };

/// Where a render is to end: what fraction and remaining time are measured against.
struct ProgressGoal {
  std::uint32_t spp_before = 0;                                 ///< that were there when the render began
  std::uint32_t spp = 0;                                        ///< 0: none
  double time_limit = std::numeric_limits<double>::infinity();  ///< seconds
  double target_error = 0;                                      ///< 0: none
};

/// Part of the way to the goal, in [0, 1]; 0 when nothing is known yet. The error shrinks as 1 / sqrt(samples).
double progress_fraction(const RenderProgress& now, const ProgressGoal& goal);

/// "12.3 s", "4:05", "1:02:03".
std::string duration(double seconds);

/// "16/64 spp, 45.2 Mrays/s, error 0.031, 12.3 s, 0:37 left"; what is not known is left out.
std::string progress_text(const RenderProgress& now, const ProgressGoal& goal);

/// Shows progress as it comes: a bar that is redrawn on a terminal, else a plain line after 2 s and then ever more
/// rarely. NO_COLOR and TERM=dumb are respected.
class ProgressReport {
 public:
  explicit ProgressReport(ProgressStyle style, ProgressGoal goal = {});
  /// Takes the bar away.
  ~ProgressReport();
  ProgressReport(const ProgressReport&) = delete;
  ProgressReport& operator=(const ProgressReport&) = delete;

  void show(const RenderProgress& now);
  /// The same for what is no single render. part: of the way, in [0, 1].
  void show(double seconds, double part, const std::string& text);
  /// Takes the bar away, and says how it ended if anything was shown before.
  void finish(const std::string& summary);

 private:
  void draw_bar(double part, const std::string& text);
  void clear_bar();

  enum class Form { none, lines, bar } form_ = Form::none;
  bool colour_ = false, drawn_ = false, said_ = false;
  double next_ = 0;  ///< second of rendering at which to show again
  ProgressGoal goal_;
};

}  // namespace tyndall
