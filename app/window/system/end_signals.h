#pragma once
#include <functional>
#include <string>
#include <thread>

/// What ends the window's program from outside: signals, and a display that goes away.
namespace tyndall {

/// Watches these signals while it lives. A second signal ends the program at once.
class EndSignals {
 public:
  /// on_signal: called from a thread of its own after the first signal.
  explicit EndSignals(std::function<void()> on_signal);
  ~EndSignals();

  /// The signal that came, or 0.
  int received() const;

 private:
  std::thread thread_;
};

/// From now on the program says so in one line and ends with exit code 3 when the X server goes away, instead of the X
/// library's words and exit code 1. Nothing happens where no X library is loaded. Call after the window was opened.
/// before_end: called first, from whichever thread has noticed it; must not use the display; may be empty. What it
/// returns is said in a line of its own, unless it is "".
void end_when_display_is_lost(std::function<std::string()> before_end);

}  // namespace tyndall
