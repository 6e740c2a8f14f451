#include "app/cli/signals.h"

#include <signal.h>
#include <unistd.h>

#include <atomic>

namespace tyndall {
namespace {

// A signal handler can reach nothing but globals; lock-free atomics are safe there.
std::atomic<int> received_signal{0};
static_assert(std::atomic<int>::is_always_lock_free);

struct Watched {
  int number;
  void (*handler)(int);
  struct sigaction before;
};

void note_signal(int number) {
  if (received_signal.exchange(number) != 0) _exit(128 + number);
}

Watched watched[] = {{SIGINT, note_signal, {}}, {SIGTERM, note_signal, {}}, {SIGPIPE, SIG_IGN, {}}};

}  // namespace

SignalWatch::SignalWatch() {
  received_signal = 0;
  for (Watched& w : watched) {
    struct sigaction action {};
    action.sa_handler = w.handler;
    action.sa_flags = SA_RESTART;
    sigaction(w.number, &action, &w.before);
  }
}

SignalWatch::~SignalWatch() {
  for (const Watched& w : watched) sigaction(w.number, &w.before, nullptr);
}

int SignalWatch::received() const { return received_signal; }

}  // namespace tyndall
