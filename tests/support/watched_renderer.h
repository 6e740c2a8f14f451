#pragma once
#include "core/render/renderer.h"
#include "tests/support/pictures.h"

#include <doctest/doctest.h>

#include <chrono>
#include <condition_variable>
#include <ctime>
#include <mutex>
#include <thread>
#include <type_traits>
#include <utility>

/// A Renderer that remembers every frame it has published. Tests wait for frames, never for a time.
namespace tyndall::test {

using FramePointer = std::shared_ptr<const Frame>;

class WatchedRenderer {
 public:
  explicit WatchedRenderer(int threads = 2, const std::string& isa = "")
      : renderer_({threads, isa}, [this] { note(); }) {}

  Renderer& operator*() { return renderer_; }
  Renderer* operator->() { return &renderer_; }

  /// What was asked for last. These change a part of it and ask again; each returns the number of the edit.
  const RenderRequest& wanted() const { return wanted_; }
  template <class T>
  std::uint64_t set(T RenderRequest::*part, std::type_identity_t<T> value) {
    wanted_.*part = std::move(value);
    return renderer_.request(wanted_);
  }
  std::uint64_t submit(std::shared_ptr<const Scene> scene, std::shared_ptr<Film> film = nullptr) {
    wanted_.film = std::move(film);
    return set(&RenderRequest::scene, std::move(scene));
  }
  std::uint64_t submit(Scene scene) { return submit(std::make_shared<const Scene>(std::move(scene))); }
  std::uint64_t pause(bool paused) { return set(&RenderRequest::paused, paused); }
  std::uint64_t set_view(View view) { return set(&RenderRequest::view, view); }
  std::uint64_t restart() { return set(&RenderRequest::restarts, wanted_.restarts + 1); }

  /// The first frame, from the `skip`-th on, that the condition holds for; waits for it. Fails after 60 s, which only
  /// ends a test that hangs.
  template <class Condition>
  FramePointer wait_for(Condition condition, std::size_t skip = 0) {
    std::unique_lock lock(mutex_);
    FramePointer found;
    const auto look = [&] {
      for (std::size_t i = skip; i < frames_.size() && !found; ++i)
        if (condition(*frames_[i])) found = frames_[i];
      return found != nullptr;
    };
    if (!news_.wait_for(lock, std::chrono::seconds(60), look)) FAIL("no such frame within a minute");
    return found;
  }
  FramePointer wait_finished(std::uint64_t edit, std::size_t skip = 0) {
    return wait_for([&](const Frame& f) { return f.edit == edit && f.finished; }, skip);
  }
  /// Waits until the condition holds; it is asked again after each frame and problem.
  template <class Condition>
  void wait_until(Condition condition) {
    std::unique_lock lock(mutex_);
    if (!news_.wait_for(lock, std::chrono::seconds(60), condition)) FAIL("it did not come true within a minute");
  }
  /// Waits until the renderer has done all that it was told before. A finished or paused renderer then stands still;
  /// another one has made a whole pass meanwhile. It works by asking for two films: the first comes after a request was
  /// taken, but perhaps before its frame is shown; the second comes after that.
  void catch_up() {
    renderer_.film();
    renderer_.film();
  }
  std::vector<FramePointer> frames() const {
    const std::lock_guard lock(mutex_);
    return frames_;
  }
  /// Calls to on_frame, which also tells of problems.
  std::size_t calls() const {
    const std::lock_guard lock(mutex_);
    return calls_;
  }

 private:
  void note() {
    const FramePointer frame = renderer_.latest();
    const std::lock_guard lock(mutex_);
    ++calls_;
    if (frame && (frames_.empty() || frames_.back() != frame)) frames_.push_back(frame);
    news_.notify_all();
  }

  RenderRequest wanted_;
  mutable std::mutex mutex_;
  std::condition_variable news_;
  std::vector<FramePointer> frames_;
  std::size_t calls_ = 0;
  Renderer renderer_;  // declared last, so that it has stopped before what it uses goes
};

/// The red, green and blue of a frame, without alpha, which must be 1.
inline std::vector<float> rgb_of(const Frame& frame) {
  std::vector<float> rgb;
  for (std::size_t i = 0; i < frame.rgba.size(); i += 4) {
    rgb.insert(rgb.end(), frame.rgba.begin() + static_cast<std::ptrdiff_t>(i),
               frame.rgba.begin() + static_cast<std::ptrdiff_t>(i + 3));
    REQUIRE(frame.rgba[i + 3] == 1.0f);
  }
  return rgb;
}

/// Lets the renderer work for a while, so that what is done next comes in the middle of something. For tests that hold
/// wherever it then is.
inline void let_it_work(std::chrono::microseconds time) { std::this_thread::sleep_for(time); }

/// Seconds of processor time that the whole process has used: other processes do not add to it.
inline double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Seconds of a clock that never goes back, for bounds that hold on the slowest machine.
inline double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace tyndall::test
