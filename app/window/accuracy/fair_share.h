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
enum class Turn { both, first, second };

/// Which renderer works next, so that both get equal seconds. together: both have threads of their own, and one waits
/// only when it is well ahead; otherwise they take turns.
Turn next_turn(Turn now, RenderingTime first, RenderingTime second, bool together);

/// Shares threads between the window's renderer and a second one, in equal core-seconds: half of the threads each where
/// their number is even, else in turns of a third of a second. Nothing here waits for rendering.
class FairShare {
 public:
  explicit FairShare(Renderer& first) : first_(first) {}
  FairShare(const FairShare&) = delete;
  FairShare& operator=(const FairShare&) = delete;

  /// second: null when it is about to go; stays with the caller.
  void share_with(Renderer* second);
  void set_threads(int threads);
  void pause(bool paused);
  /// After each frame of either; from any thread.
  void on_frame();

 private:
  void set_up();
  void apply();
  bool together() const { return threads_ >= 2 && threads_ % 2 == 0; }

  std::mutex mutex_;
  Renderer& first_;
  Renderer* second_ = nullptr;
  int threads_ = 1;
  bool paused_ = false;
  Turn turn_ = Turn::both;
};

}  // namespace tyndall
