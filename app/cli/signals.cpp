#include "app/cli/signals.h"

#include <signal.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>

namespace tyndall {
namespace {

// A signal handler can reach nothing but globals; lock-free atomics are safe there.
std::atomic<int> received_signal{0};
std::atomic<std::int64_t> received_at{0};  ///< milliseconds
std::atomic<bool> save_request{false};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<std::int64_t>::is_always_lock_free);

/// A program such as timeout signals the process and then its group: what comes within this time is the same request.
constexpr std::int64_t same_request_ms = 200;

std::int64_t now_ms() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * 1000 + now.tv_nsec / 1000000;
}

/// Asks for an end. SIGXCPU comes again every second, SIGHUP from the shell and from the terminal: no reason to hurry.
void ask_for_end(int number) {
  int none = 0;
  if (received_signal.compare_exchange_strong(none, number)) received_at = now_ms();
}

void ask_for_end_or_end(int number) {
  if (received_signal != 0 && received_at != 0 && now_ms() - received_at > same_request_ms) _exit(128 + number);
  ask_for_end(number);
}

void ask_for_save(int) { save_request = true; }

struct Watched {
  int number;
  void (*handler)(int);
  bool stays_ignored;  ///< if it was when the program started
  struct sigaction before;
};

Watched watched[] = {{SIGINT, ask_for_end_or_end, false, {}}, {SIGTERM, ask_for_end_or_end, true, {}},
                     {SIGHUP, ask_for_end, true, {}},         {SIGXCPU, ask_for_end, true, {}},
                     {SIGUSR2, ask_for_end, true, {}},        {SIGALRM, ask_for_end, true, {}},
                     {SIGUSR1, ask_for_save, true, {}},       {SIGPIPE, SIG_IGN, true, {}}};

}  // namespace

SignalWatch::SignalWatch() {
  received_signal = 0;
  received_at = 0;
  save_request = false;
  for (Watched& w : watched) {
    sigaction(w.number, nullptr, &w.before);
    if (w.stays_ignored && w.before.sa_handler == SIG_IGN) continue;
    struct sigaction action {};
    action.sa_handler = w.handler;
    action.sa_flags = SA_RESTART;
    sigaction(w.number, &action, nullptr);
  }
}

SignalWatch::~SignalWatch() {
  for (const Watched& w : watched) sigaction(w.number, &w.before, nullptr);
}

int SignalWatch::received() const { return received_signal; }
bool SignalWatch::take_save_request() const { return save_request.exchange(false); }

}  // namespace tyndall
