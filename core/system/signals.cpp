#include "core/system/signals.h"

#include <signal.h>
#include <unistd.h>

#include <array>
#include <iterator>
#include <utility>

namespace tyndall {
namespace {

static_assert(signal_kill == SIGKILL && signal_terminate == SIGTERM);

using Clock = std::chrono::steady_clock;

// A signal handler can reach nothing but globals; lock-free atomics are safe there.
std::atomic<int> received_signal{0};
std::atomic<Clock::rep> received_at{0};
std::atomic<bool> save_request{false};
std::atomic<int> watches{0};  ///< that live
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<Clock::rep>::is_always_lock_free);

/// A program such as timeout signals the process and then its group: what comes within this time is the same request.
constexpr Clock::rep same_request = Clock::duration(std::chrono::milliseconds(200)).count();

Clock::rep now() { return Clock::now().time_since_epoch().count(); }

/// Asks for an end. SIGXCPU comes again every second, SIGHUP from the shell and from the terminal: no reason to hurry.
void ask_for_end(int number) {
  if (int none = 0; received_signal.compare_exchange_strong(none, number)) received_at = now();
}

void ask_for_end_or_end(int number) {
  if (received_signal != 0 && received_at != 0 && now() - received_at > same_request) _exit(128 + number);
  ask_for_end(number);
}

void ask_for_save(int) { save_request = true; }

using Handler = void (*)(int);
struct Watched {
  int number;
  Handler handlers[3];  ///< of WatchedSignals end, window and render; null: the signal is left alone
};
const Watched watched[] = {{SIGINT, {ask_for_end, ask_for_end_or_end, ask_for_end_or_end}},
                           {SIGTERM, {ask_for_end, ask_for_end_or_end, ask_for_end_or_end}},
                           {SIGHUP, {ask_for_end, ask_for_end_or_end, ask_for_end}},
                           {SIGXCPU, {nullptr, nullptr, ask_for_end}},
                           {SIGUSR2, {nullptr, nullptr, ask_for_end}},
                           {SIGALRM, {nullptr, nullptr, ask_for_end}},
                           {SIGUSR1, {nullptr, nullptr, ask_for_save}},
                           {SIGPIPE, {nullptr, nullptr, SIG_IGN}}};

}  // namespace

SignalWatch::SignalWatch(WatchedSignals signals, std::function<void()> on_end) {
  if (signals == WatchedSignals::none) return;
  if (watches++ == 0) received_signal = 0, received_at = 0, save_request = false;
  std::array<struct sigaction, std::size(watched)> before{};
  for (std::size_t k = 0; k < std::size(watched); ++k) {
    struct sigaction action {};
    action.sa_handler = watched[k].handlers[static_cast<int>(signals) - static_cast<int>(WatchedSignals::end)];
    action.sa_flags = SA_RESTART;
    sigaction(watched[k].number, nullptr, &before[k]);
    const bool stays = before[k].sa_handler == SIG_IGN && watched[k].number != SIGINT;
    if (action.sa_handler && !stays) sigaction(watched[k].number, &action, nullptr);
  }
  restore_ = [before] {
    for (std::size_t k = 0; k < std::size(watched); ++k) sigaction(watched[k].number, &before[k], nullptr);
    --watches;
  };
  if (on_end) thread_.emplace([this, call = std::move(on_end)] { tell_end(call); });
}

int SignalWatch::received() const { return restore_ ? received_signal.load() : 0; }
bool SignalWatch::take_save_request() const { return save_request.exchange(false); }

void ignore_lost_pipes() { signal(SIGPIPE, SIG_IGN); }

std::string signal_name(int signal) {
  constexpr std::pair<int, const char*> names[] = {{SIGSEGV, "SIGSEGV, a pointer to nowhere"},
                                                   {SIGABRT, "SIGABRT"},
                                                   {SIGFPE, "SIGFPE, a division by 0"},
                                                   {SIGBUS, "SIGBUS"},
                                                   {SIGILL, "SIGILL"},
                                                   {SIGKILL, "SIGKILL, often for lack of memory"},
                                                   {SIGTERM, "SIGTERM"},
                                                   {SIGXCPU, "SIGXCPU"},
                                                   {SIGXFSZ, "SIGXFSZ, a file that is too large"}};
  for (const auto& [number, name] : names)
    if (number == signal) return name;
  return "signal " + std::to_string(signal);
}

}  // namespace tyndall
