#pragma once
#include "core/base/seconds.h"
#include "core/render/frame.h"
#include "core/render/prepare.h"
#include "core/system/locks.h"

#include <atomic>
#include <functional>
#include <future>
#include <mutex>
#include <utility>
#include <vector>

/// Passes messages between the threads that use a Renderer and the renderer's own thread.
namespace tyndall {

/// A request as the render loop receives it.
struct ReceivedRequest {
  RenderRequest wanted;
  std::uint64_t edit = 0;   ///< number of its scene; 0: it has none
  Clock::time_point since;  ///< when its scene, or its newest restart, was requested

  /// Samples a pixel at which the picture is finished; 0: there is no scene.
  std::uint32_t full_spp() const;
  /// Samples a pixel at which to stop: no more than 1 while it is paused.
  std::uint32_t limit() const { return wanted.paused ? std::min(full_spp(), 1u) : full_spp(); }
};

/// The differences between a request and the one before it.
struct RequestChange {
  bool scene = false, restart = false, threads = false, pixel = false;
  bool drawing = false;  ///< the present samples have to be shown in another way
  bool limit = false;    ///< the limit, on which Frame::finished depends
  bool any() const { return scene || restart || threads || pixel || drawing || limit; }
  /// Whether the change cannot wait for the end of the current pass.
  bool is_urgent() const { return scene || restart || threads || drawing; }
};
RequestChange change_between(const ReceivedRequest& before, const ReceivedRequest& after);

/// Messages between any number of callers and the one thread that renders. A newer request replaces the one before. No
/// call but wait() and wait_until_shown() sleeps. Scenes are shared, never copied.
class Mailbox {
 public:
  // For callers, on any thread.

  /// See Renderer.
  std::uint64_t request(RenderRequest request);
  void note_shown(std::uint64_t pass);
  std::future<Film> ask_for_film();
  RenderReply reply() const {
    const std::lock_guard lock(mutex_);
    return reply_;
  }
  std::shared_ptr<const PreparedScene> prepared() const {
    const std::lock_guard lock(mutex_);
    return prepared_;
  }

  // For the thread that renders.

  /// Sleeps until the request has changed, a film was requested, or `unfinished`, called with the limit in samples a
  /// pixel, returns true. Returns false if the thread is to stop.
  bool wait(const std::function<bool(std::uint32_t limit)>& unfinished);
  /// Returns the newest request, and clears give_up().
  ReceivedRequest take() {
    const std::lock_guard lock(mutex_);
    give_up_ = false;
    return taken_ = newest_;
  }
  std::vector<std::promise<Film>> take_film_requests() {
    const std::lock_guard lock(mutex_);
    return std::exchange(films_, {});
  }
  /// Waits until the frame of that pass is on the screen, an urgent request comes, or 50 ms have passed. Returns the
  /// seconds from the frame's posting to the screen, if it is there. Does not wait if no caller has ever reported a
  /// shown frame.
  std::optional<double> wait_until_shown(std::uint64_t pass);
  /// True as soon as a caller wants something that cannot wait for the end of the current pass.
  const std::atomic<bool>& give_up() const { return give_up_; }
  /// Makes the thread that renders leave its pass and stop.
  void stop() {
    const std::lock_guard lock(mutex_);
    give_up_ = stops_ = true;
    news_.notify_one();
  }
  bool stops() const { return stops_; }
  /// Publishes a frame. Sets Frame::finished, as the limit may have changed since the frame was begun.
  void post(std::shared_ptr<Frame> frame);
  void post(RenderProblem problem) {
    const std::lock_guard lock(mutex_);
    reply_.problem = std::make_shared<const RenderProblem>(std::move(problem));
  }
  void post(PixelReport report) {
    const std::lock_guard lock(mutex_);
    reply_.pixel = std::make_shared<const PixelReport>(report);
  }
  /// Publishes the scene that is rendered from now on, and withdraws the problem of an earlier one.
  void post(std::shared_ptr<const PreparedScene> scene);

 private:
  mutable Mutex mutex_;  ///< guards all but give_up_ and stops_
  Condition news_;
  std::atomic<bool> give_up_ = false, stops_ = false;

  ReceivedRequest newest_, taken_;
  std::vector<std::promise<Film>> films_;

  std::uint64_t shown_pass_ = 0;  ///< Frame::pass of the newest frame on the screen; 0: none was reported
  Clock::time_point shown_at_, posted_at_;

  RenderReply reply_;
  std::shared_ptr<const PreparedScene> prepared_;
};

}  // namespace tyndall
