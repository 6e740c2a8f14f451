#pragma once
#include "core/base/stoppable.h"
#include "core/render/prepare.h"
#include "core/render/render_request.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <future>
#include <mutex>
#include <vector>

/// Where the threads that use a Renderer and the renderer's own thread meet.
namespace tyndall {

using Clock = std::chrono::steady_clock;

/// A request as the render loop gets it.
struct ReceivedRequest {
  RenderRequest wanted;
  std::uint64_t edit = 0;   ///< number of its scene; 0: it has none
  Clock::time_point since;  ///< when its scene, or its newest restart, was asked for

  /// Samples a pixel at which the picture is finished; 0: there is no scene.
  std::uint32_t full_spp() const;
  /// Samples a pixel at which to stop: no more than 1 while it is paused.
  std::uint32_t limit() const { return wanted.paused ? std::min(full_spp(), 1u) : full_spp(); }
};

/// What a request wants that the one before it did not.
struct RequestChange {
  bool scene = false, restart = false, threads = false, pixel = false;
  bool drawing = false;  ///< the present samples have to be shown in another way
  bool limit = false;    ///< frames tell whether they are finished
  bool any() const { return scene || restart || threads || pixel || drawing || limit; }
  /// It cannot wait for the end of the pass that is under way.
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
  RenderReply reply() const;
  std::shared_ptr<const PreparedScene> prepared() const;

  // For the thread that renders.

  /// Sleeps until the request has changed, a film was asked for or `unfinished`, called with the limit in samples a
  /// pixel, is true. False: the thread is to stop.
  bool wait(const StopToken& stop, const std::function<bool(std::uint32_t limit)>& unfinished);
  /// Takes the newest request, and lowers the flag to give up.
  ReceivedRequest take();
  std::vector<std::promise<Film>> take_film_requests();
  /// Waits until the frame of that pass is on the screen, until something urgent is asked for, or 50 ms. Returns the
  /// seconds that it took from the frame's posting to the screen, if it is there. Does not wait if no caller has ever
  /// told of a frame on the screen.
  std::optional<double> wait_until_shown(std::uint64_t pass);
  /// True as soon as a caller wants something that cannot wait for the end of the pass that is under way.
  const std::atomic<bool>& give_up() const { return give_up_; }
  /// Makes the thread that renders leave its pass and look at its stop token.
  void interrupt() {
    give_up_ = true;
    news_.notify_one();
  }
  /// Hands a frame out. Sets whether it is finished, as the limit may have changed since the frame was begun.
  void post(std::shared_ptr<Frame> frame);
  void post(RenderProblem problem);
  void post(PixelReport report);
  /// Hands out the scene that is rendered from now on, and withdraws the problem of an earlier one.
  void post(std::shared_ptr<const PreparedScene> scene);

 private:
  mutable std::mutex mutex_;  ///< guards all but give_up_
  StoppableCondition news_;
  std::atomic<bool> give_up_ = false;

  ReceivedRequest newest_, taken_;
  std::vector<std::promise<Film>> films_;

  std::uint64_t shown_pass_ = 0;  ///< Frame::pass of the newest frame on the screen; 0: nobody tells
  Clock::time_point shown_at_, posted_at_;

  RenderReply reply_;
  std::shared_ptr<const PreparedScene> prepared_;
};

}  // namespace tyndall
