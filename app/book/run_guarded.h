#pragma once
#include "core/system/child.h"

#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>

namespace tyndall {

/// The user asked for an end, by a signal, while a program was compiled or run.
struct ProgramInterrupted : std::runtime_error {
  ProgramInterrupted(const std::string& text, int number) : std::runtime_error(text), signal(number) {}
  int signal;
};

/// What compiling and running have in common.
struct ProgramTask {
  std::string name;              ///< what messages call the program
  std::filesystem::path folder;  ///< of temporary files, that exists; a whole path without links
  std::function<bool()> go_on;   ///< see ChildPlan
  bool watch_signals = true;     ///< SIGINT, SIGTERM and SIGHUP end it
  bool trusted = false;          ///< it is also run where the system has no guard
  std::string compiler{};        ///< "": $CXX, else c++, g++ or clang++
};

/// The plan under guard: what is run can change nothing outside the task's folder. Throws UsageError where the system
/// has no guard, and the program is not trusted.
ChildPlan guarded(const ProgramTask& task, ChildPlan plan);

/// Runs it so to its end. doing: "it ran", for messages. Throws ProgramInterrupted, too.
ChildEnd run_guarded(const ProgramTask& task, ChildPlan plan, const std::string& doing);

}  // namespace tyndall
