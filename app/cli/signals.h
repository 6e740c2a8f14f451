#pragma once

/// Signals while rendering: those that ask for an end, and the one that asks for the picture so far.
namespace tyndall {

/// Watches signals while it lives. The first of SIGINT (Ctrl-C), SIGTERM, SIGHUP (the terminal is gone), SIGXCPU (the
/// processor time is used up), SIGUSR2 and SIGALRM (batch systems send them before the end) asks for an end; a SIGINT
/// or SIGTERM after that ends at once. SIGUSR1 asks for the picture so far. SIGPIPE is ignored, so that a closed
/// standard error ends no render.
///
/// What was ignored when the program started stays ignored (nohup), but for SIGINT: shells ignore it for all jobs in
/// the background, which "kill -INT" must still reach.
class SignalWatch {
 public:
  SignalWatch();
  ~SignalWatch();
  SignalWatch(const SignalWatch&) = delete;
  SignalWatch& operator=(const SignalWatch&) = delete;

  /// The signal that asked for an end, or 0.
  int received() const;
  /// Whether SIGUSR1 came since the last call.
  bool take_save_request() const;
};

}  // namespace tyndall
