#pragma once
#include "app/files/viewer_stream.h"
#include "core/clean/clean.h"
#include "core/render/prepare.h"

#include <chrono>

/// Shows a render in a viewer (--watch-at) while it goes on.
namespace tyndall {

/// Makes the frames, which takes the threads' time, and so seldom that this costs less than 1 % of it; of a viewer that
/// is not there, or does not read, none are made. The clean view takes most of the time, so it comes more seldom, and
/// always at the end.
class LiveView {
 public:
  /// name: what the viewer calls the picture. prepared: is used as long as this lives.
  LiveView(const ViewerAddress& address, const std::string& name, const PreparedScene& prepared, std::string isa,
           int threads);

  bool due() const;
  /// Sends the film as it is. thread_pool: idle.
  void take(const Film& film, ThreadPool& thread_pool);
  /// Sends the finished picture and waits until the viewer has it, as ViewerStream::finish() does. clean: the film's
  /// clean view, null: it is made here. Does nothing if there is no viewer.
  void finish(const Film& film, const CleanPicture* clean);
  /// What went wrong with the viewer, once.
  std::optional<std::string> problem() { return stream_.problem(); }

 private:
  using Clock = std::chrono::steady_clock;
  void send(const Film& film, ThreadPool& thread_pool);

  const PreparedScene& prepared_;
  std::string isa_;
  int threads_;
  ViewerStream stream_;
  std::vector<float> clean_;  ///< the newest; empty: none yet
  Clock::time_point start_ = Clock::now(), last_ = start_, last_clean_ = start_;
  double cost_;        ///< seconds that the last frame took, or an estimate
  double clean_cost_;  ///< likewise the clean view
};

}  // namespace tyndall
