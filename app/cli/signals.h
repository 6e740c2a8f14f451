#pragma once

/// Ctrl-C and SIGTERM while rendering: the first one asks for an end, a second one ends at once.
namespace tyndall {

/// Watches SIGINT and SIGTERM while it lives, also where they were ignored (shells do that to background jobs), and
/// ignores SIGPIPE so that a closed standard error ends no render.
class SignalWatch {
 public:
  SignalWatch();
  ~SignalWatch();
  SignalWatch(const SignalWatch&) = delete;
  SignalWatch& operator=(const SignalWatch&) = delete;

  /// The signal that came, or 0.
  int received() const;
};

}  // namespace tyndall
