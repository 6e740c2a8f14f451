#pragma once
#include "app/cli/render_job.h"
#include "app/text/progress.h"
#include "core/system/signals.h"

#include <cstddef>
#include <set>
#include <string>

/// Pictures that one command renders one after the other.
namespace tyndall {

/// Renders each, and tells how far all of them are.
class Series {
 public:
  /// count: of pictures that are to be rendered.
  Series(ProgressStyle style, std::size_t count) : report_(style), count_(count) {}

  /// name: "frame 12".
  RenderResult render(RenderJob& job, const std::string& name);
  /// Tells what users should know of a picture; what holds for several, once.
  void warn(const RenderJob& job, const RenderOutcome& outcome, const std::string& name);
  void finish(const std::string& how, const std::string& summary);

  /// The signal that asked for an end; 0: none did.
  int signal() const { return signals_.received(); }
  std::size_t made() const { return made_; }   ///< pictures that are whole
  double seconds() const { return seconds_; }  ///< of rendering
  std::size_t left() const { return count_ - made_; }

 private:
  SignalWatch signals_;
  ProgressReport report_;
  std::size_t count_, made_ = 0;
  double seconds_ = 0;
  std::set<std::string> told_;
};

/// Lets a job start with a whole film, to which nothing is added.
void take_film(RenderJob& job, Film film);

}  // namespace tyndall
