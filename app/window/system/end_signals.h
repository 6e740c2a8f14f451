#pragma once
#include <functional>
#include <thread>

/// Signals that ask the window's program to end: SIGINT (Ctrl-C), SIGTERM, SIGHUP.
namespace tyndall {

/// Watches these signals while it lives. A second signal ends the program at once.
class EndSignals {
 public:
  /// on_signal: called from a thread of its own after the first signal.
  explicit EndSignals(std::function<void()> on_signal);
  ~EndSignals();
  EndSignals(const EndSignals&) = delete;
  EndSignals& operator=(const EndSignals&) = delete;

  /// The signal that came, or 0.
  int received() const;

 private:
  std::thread thread_;
};

}  // namespace tyndall
