#pragma once
#include "core/base/stoppable.h"
#include "core/film/film.h"
#include "core/render/frame.h"
#include "core/render/prepare.h"
#include "core/scene/scene.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

/// Where the threads that use a Renderer and the renderer's own thread meet.
namespace tyndall {

using Clock = std::chrono::steady_clock;

/// Which parts of a scene an edit has changed, among those on which samples depend. The scene's name, its display
/// settings and the number of samples at which to stop are not among them.
struct SceneChange {
  bool camera = false;
  bool others = false;  ///< anything but the camera
  bool none() const { return !camera && !others; }
};
SceneChange change_between(const Scene& before, const Scene& after);

/// All that has been asked of the renderer since its thread last looked.
struct Orders {
  std::shared_ptr<const Scene> scene;  ///< the newest one, if it has not been taken before; else null
  std::shared_ptr<Film> film;          ///< samples that it has already; null: none
  std::uint64_t edit = 0;              ///< number of that scene
  Clock::time_point submitted;         ///< when it came
  bool restart = false;
  bool redraw = false;  ///< the view or the limit has changed: the present samples have to be shown again
  View view = View::beauty;
  bool clean = false;             ///< whether the clean view is wanted
  std::uint32_t limit = 0;        ///< samples a pixel at which to stop; at most 1 while the renderer is paused
  int threads = 0;                ///< how many to use; 0: as many as before
  std::int64_t shown_pixels = 0;  ///< see Renderer::set_shown_pixels
  Region first;                   ///< see Renderer::refine_first
  std::optional<std::pair<int, int>> pixel;  ///< of which reports are wanted
};

/// Messages between any number of callers and the one thread that renders. A newer scene replaces one that has not been
/// taken yet. No call but wait() and wait_until_shown() sleeps. Scenes are shared, never copied.
class Mailbox {
 public:
  // For callers, on any thread.

  /// Gives the renderer another scene. Returns the number of the edit; a scene that changes nothing of what is rendered
  /// keeps the number of the one before.
  /// film: see Renderer; with one the scene is always taken.
  std::uint64_t submit(std::shared_ptr<const Scene> scene, std::shared_ptr<Film> film = nullptr);
  /// Stops after the pass that is under way, or goes on.
  void pause(bool paused);
  bool paused() const;
  void restart();
  void set_view(View view);
  void set_clean(bool clean);
  void set_threads(int threads);
  void set_shown_pixels(std::int64_t pixels);
  void note_shown(std::uint64_t pass);
  void refine_first(const Region& part);
  void watch_pixel(std::optional<std::pair<int, int>> pixel);
  std::shared_ptr<const PixelReport> pixel() const;
  std::future<Film> ask_for_film();
  std::shared_ptr<const Frame> latest() const;
  std::shared_ptr<const RenderProblem> problem() const;
  std::shared_ptr<const PreparedScene> prepared() const;

  // For the thread that renders.

  /// Sleeps until something was asked for or `unfinished`, called with the limit in samples a pixel, is true. False:
  /// the thread is to stop.
  bool wait(const StopToken& stop, const std::function<bool(std::uint32_t limit)>& unfinished);
  /// Takes what was asked for, and lowers the flag to give up.
  Orders take();
  std::vector<std::promise<Film>> take_film_requests();
  /// Waits until the frame of that pass is on the screen, until something else is asked for, or 50 ms. Returns the
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
  std::uint32_t limit() const { return paused_ ? std::min(limit_, 1u) : limit_; }
  void wake(bool give_up);

  mutable std::mutex mutex_;  ///< guards all but give_up_
  StoppableCondition news_;
  std::atomic<bool> give_up_ = false;

  std::shared_ptr<const Scene> newest_;  ///< null: none came yet
  Orders orders_;                        ///< not yet taken; its limit is unused, as pausing changes it
  std::uint32_t limit_ = 0;
  bool paused_ = false, other_pixel_ = false;
  std::vector<std::promise<Film>> films_;

  std::uint64_t shown_pass_ = 0;  ///< Frame::pass of the newest frame on the screen; 0: nobody tells
  Clock::time_point shown_at_, posted_at_;

  std::shared_ptr<const Frame> latest_;
  std::shared_ptr<const RenderProblem> problem_;
  std::shared_ptr<const PixelReport> pixel_;
  std::shared_ptr<const PreparedScene> prepared_;
};

}  // namespace tyndall
