#pragma once
#include "core/render/renderer.h"

#include <mutex>

/// Lets the two renderers of a split view have equal parts of the processors, so that their errors can be compared.
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

/// Asks the window's renderer and, in a split view, a second one for what is wanted, and shares threads between them in
/// equal core-seconds: half of the threads each where their number is even, else in turns of a third of a second.
/// Nothing here waits for rendering.
class ThreadBudget {
 public:
  explicit ThreadBudget(Renderer& first) : first_(first) {}
  ThreadBudget(const ThreadBudget&) = delete;
  ThreadBudget& operator=(const ThreadBudget&) = delete;

  /// second: null when it is about to go; stays with the caller. What it is asked for comes with request().
  void split_with(Renderer* second);
  /// Numbers of the edits that renderers were asked for.
  struct Edits {
    std::uint64_t first = 0, second = 0;
  };
  /// RenderRequest::threads is here that of both together.
  Edits request(RenderRequest first, RenderRequest second);
  /// After each frame of either; from any thread.
  void on_frame();

 private:
  Edits ask();
  RenderRequest part_of(const RenderRequest& wanted, bool waits) const;
  bool together() const { return first_wanted_.threads >= 2 && first_wanted_.threads % 2 == 0; }
  Active first_turn() const { return second_ && !together() ? Active::first : Active::both; }

  std::mutex mutex_;
  Renderer& first_;
  Renderer* second_ = nullptr;
  RenderRequest first_wanted_, second_wanted_;
  Active active_ = Active::both;
};

}  // namespace tyndall
