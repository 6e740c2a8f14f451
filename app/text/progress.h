#pragma once
#include "core/render/render.h"

#include <cstdint>
#include <string>

/// Tells on standard error how a render is going.
namespace tyndall {

/// A bar on a terminal, else plain; a line now and then; nothing.
enum class ProgressStyle { automatic, plain, none };

/// Part of the way to the nearest limit of a render, in [0, 1]; 0 when nothing is known yet. The error shrinks as
/// 1 / sqrt(samples). spp_before: samples a pixel that were there when the render began.
double progress_fraction(const RenderProgress& now, const RenderOptions& limits, std::uint32_t spp_before = 0);

/// "12.3 s", "4:05", "1:02:03".
std::string duration(double seconds);

/// "16/64 spp"; where their number is not limited "16 spp".
std::string samples_text(const RenderProgress& now, const RenderOptions& limits);
/// "16/64 spp, 45.2 Mrays/s, error 0.031, 12.3 s, 0:37 left"; what is not known is left out.
std::string progress_text(const RenderProgress& now, const RenderOptions& limits, std::uint32_t spp_before = 0);

/// Shows progress as it comes: a bar that is redrawn on a terminal, else a plain line after 2 s and then ever more
/// rarely. NO_COLOR and TERM=dumb are respected.
class ProgressReport {
 public:
  explicit ProgressReport(ProgressStyle style);
  /// Takes the bar away.
  ~ProgressReport();
  ProgressReport(const ProgressReport&) = delete;
  ProgressReport& operator=(const ProgressReport&) = delete;

  /// seconds: since the work began; part: how much of it is done, in [0, 1].
  void show(double seconds, double part, const std::string& text);
  /// Says something else in a line of its own, also where no progress is shown.
  void say(const std::string& text);
  /// Takes the bar away, and says how it ended if anything was shown before.
  void finish(const std::string& summary);

 private:
  void clear_bar();

  enum class Form { none, lines, bar } form_ = Form::none;
  bool drawn_ = false, said_ = false;
  double next_ = 0;  ///< second of rendering at which to show again
};

}  // namespace tyndall
