#include "app/book/run_guarded.h"

#include "core/base/error.h"

#include <atomic>
#include <csignal>
#include <utility>

namespace tyndall {
namespace {

std::atomic<int> received_signal{0};  // a signal handler can reach nothing but globals
constexpr int watched[] = {SIGINT, SIGTERM, SIGHUP};
struct sigaction before[3];

/// Keeps the signal in mind, and passes it on to who watched before.
void on_signal_number(int number) {
  received_signal = number;
  for (std::size_t k = 0; k < 3; ++k)
    if (watched[k] == number && before[k].sa_handler != SIG_DFL && before[k].sa_handler != SIG_IGN)
      before[k].sa_handler(number);
}

}  // namespace

EndWatch::EndWatch(bool watches) : watches_(watches) {
  received_signal = 0;
  struct sigaction action {};
  action.sa_handler = on_signal_number;
  for (std::size_t k = 0; watches_ && k < 3; ++k) {
    sigaction(watched[k], nullptr, &before[k]);
    const bool ignored = before[k].sa_handler == SIG_IGN;
    if (!ignored || watched[k] == SIGINT) sigaction(watched[k], &action, nullptr);
  }
}

EndWatch::~EndWatch() {
  for (std::size_t k = 0; watches_ && k < 3; ++k) sigaction(watched[k], &before[k], nullptr);
}

int EndWatch::received() const { return watches_ ? received_signal.load() : 0; }

ChildPlan guarded(const ProgramTask& task, ChildPlan plan) {
  plan.guard = available_guard();
  plan.own_folder = task.folder;
  if (!plan.guard.any() && !task.trusted)
    throw UsageError(
        task.name +
        ": is not run: this system has nothing that keeps a program from changing your files (neither user "
        "namespaces nor Landlock); --trust runs it as it is");
  return plan;
}

ChildEnd run_guarded(const ProgramTask& task, ChildPlan plan, const std::string& doing) {
  plan = guarded(task, std::move(plan));
  const EndWatch signals(task.watch_signals);
  plan.go_on = [&] { return signals.received() == 0 && (!task.go_on || task.go_on()); };
  ChildEnd end = run_child(plan);
  if (signals.received() != 0) throw ProgramInterrupted(task.name + ": interrupted while " + doing, signals.received());
  if (end.given_up) throw ProgramInterrupted(task.name + ": given up while " + doing, SIGTERM);
  return end;
}

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
