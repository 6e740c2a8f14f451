#pragma once
#include "core/system/locks.h"

#include <atomic>
#include <chrono>
#include <functional>
#include <optional>
#include <string>

/// Signals: those that ask for an end, and the one that asks for the picture so far.
namespace tyndall {

inline constexpr int signal_kill = 9, signal_terminate = 15;

/// The signal's name, and what it is mostly for: "SIGFPE, a division by 0".
std::string signal_name(int signal);

/// Signals that a part of the program watches.
enum class WatchedSignals {
  none,
  end,     ///< SIGINT (Ctrl-C), SIGTERM and SIGHUP (the terminal is gone) ask for an end, as often as they come
  window,  ///< the same; the second one ends at once
  render   ///< and SIGXCPU (the processor time is used up), SIGUSR2 and SIGALRM (batch systems send them before the
           ///< end); a second SIGINT or SIGTERM ends at once. SIGUSR1 asks for the picture so far. SIGPIPE is ignored,
           ///< so that a closed standard error ends no render.
};

/// Watches signals while it lives. Watches may be nested: then each of them sees what comes.
///
/// What was ignored when the program started stays ignored (nohup), but for SIGINT: shells ignore it for all jobs in
/// the background, which "kill -INT" must still reach.
class SignalWatch {
 public:
  /// on_end: called from a thread of its own after the first signal; may be empty.
  explicit SignalWatch(WatchedSignals signals = WatchedSignals::render, std::function<void()> on_end = {});
  ~SignalWatch() {
    if (restore_) restore_();
    ends_ = true;
  }
  SignalWatch(const SignalWatch&) = delete;
  SignalWatch& operator=(const SignalWatch&) = delete;

  /// The signal that asked for an end, or 0.
  int received() const;
  /// Whether SIGUSR1 came since the last call.
  bool take_save_request() const;

 private:
  /// The work of the thread. A handler of signals can wake none, so it looks some times a second.
  void tell_end(const std::function<void()>& on_end) const {
    while (!ends_ && received() == 0) std::this_thread::sleep_for(std::chrono::milliseconds(50));
    if (received() != 0) on_end();
  }

  std::function<void()> restore_;  ///< gives the signals back to those who had them before; empty: none is watched
  std::atomic<bool> ends_ = false;
  std::optional<JoinedThread> thread_;  // declared last, because it uses the others
};

/// A pipe or connection that breaks fails with an error from now on, and ends the program no more.
void ignore_lost_pipes();

}  // namespace tyndall
