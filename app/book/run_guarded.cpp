#include "app/book/run_guarded.h"

#include "core/base/error.h"
#include "core/system/signals.h"

#include <utility>

namespace tyndall {

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
  const SignalWatch signals(task.watch_signals ? WatchedSignals::end : WatchedSignals::none);
  plan.go_on = [&] { return signals.received() == 0 && (!task.go_on || task.go_on()); };
  ChildEnd end = run_child(plan);
  if (signals.received() != 0) throw ProgramInterrupted(task.name + ": interrupted while " + doing, signals.received());
  if (end.given_up) throw ProgramInterrupted(task.name + ": given up while " + doing, signal_terminate);
  return end;
}

}  // namespace tyndall
