#pragma once
#include "app/window/accuracy/half.h"
#include "core/render/render_request.h"

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

}  // namespace tyndall
