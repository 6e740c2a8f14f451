#pragma once
#include "app/window/accuracy/comparison.h"
#include "core/render/frame.h"
#include "core/render/renderer.h"
#include "core/system/locks.h"

#include <atomic>
#include <functional>
#include <memory>
#include <string>

/// This room makes the pictures and shows them: the renderers behind the window, one or two while the view is split,
/// and their frames on the screen.
namespace tyndall {

/// How far one of two renderers is with the same edit.
struct RenderingTime {
  double seconds = 0;     ///< of rendering since the edit
  bool finished = false;  ///< it does not work any more
};

/// Which of two renderers may work.
enum class Active { both, first, second };

/// Which renderer works next, so that both get equal seconds. together: both have threads of their own, and one waits
/// only when it is well ahead; otherwise they take turns.
Active next_active(Active now, RenderingTime first, RenderingTime second, bool together);

/// Shares threads between the halves of a split view, in equal core-seconds: half of the threads each where their
/// number is even, else in turns of a third of a second.
class ThreadBudget {
 public:
  /// threads: of both together. split: there are two.
  void begin(int threads, bool split);
  /// After a frame of either. Returns whether the other one may work from now on, or both may.
  bool go_on(RenderingTime current, RenderingTime kept);
  /// What a half's renderer is to be asked for, so that it takes its part and no more.
  RenderRequest part_of(RenderRequest wanted, Half half) const;

 private:
  bool together() const { return threads_ >= 2 && threads_ % 2 == 0; }

  int threads_ = 0;
  bool split_ = false;
  Active active_ = Active::both;
};

/// The window's renderer and, in a split view, a second one for the left half. Both get the same processor time. For
/// the main thread unless it says otherwise; nothing here waits for rendering.
class RendererPair {
 public:
  /// threads: of both together, > 0. on_frame: called from a thread of a renderer after each frame.
  RendererPair(int threads, std::string isa, std::function<void()> on_frame);
  ~RendererPair();

  /// What a request has led to.
  struct Begun {
    bool current = false, kept = false;  ///< these halves have begun another picture
    /// The second renderer when the split view ends. Destroying it can take as long as a unit of its work, so the
    /// caller should do that where nobody waits.
    std::shared_ptr<Renderer> ended;
  };
  /// Asks for these pictures; the same ones again cost nothing. threads: of both together. kept: of the left half of a
  /// split view; without a scene there is none.
  Begun request(const RenderRequest& current, const RenderRequest& kept = {});
  /// A half's frame of that pass is on the screen, see Renderer.
  void note_shown(Half half, std::uint64_t pass);

  /// The newest frame; null: there is none. From any thread.
  std::shared_ptr<const Frame> latest(Half half) const;
  /// Number of the newest edit that a half was asked for. That of the current half from any thread.
  std::uint64_t edit(Half half) const { return half == Half::kept ? kept_edit_ : edit_.load(); }
  /// Nothing renders: paused, or all pictures are finished.
  bool resting() const;
  /// Whether the newest pictures of all halves are finished, in the view that was asked for: no other frame comes by
  /// itself. A paused picture is not finished.
  bool finished() const;
  /// Of the current half, see Renderer; the film from any thread.
  Film film() const { return renderer_.film(); }
  Renderer::Pick pick(int x, int y) const { return renderer_.pick(x, y); }
  RenderReply reply() const { return renderer_.reply(); }

 private:
  void on_frame_of_either();

  std::string isa_;
  std::function<void()> told_;
  mutable Mutex mutex_;           ///< guards what follows, and second_
  RenderRequest current_, kept_;  ///< the newest ones
  ThreadBudget budget_;
  std::atomic<std::uint64_t> edit_ = 0;
  std::uint64_t kept_edit_ = 0;
  std::uint64_t restarted_after_ = 0;  ///< the newest pass of the current half when it was last started over
  Renderer renderer_;
  std::shared_ptr<Renderer> second_;  ///< of the left half; null: there is no split view
};

}  // namespace tyndall
