#pragma once
#include "core/system/child.h"

#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace tyndall {

/// The user asked for an end, by a signal, while a program was compiled or run.
struct ProgramInterrupted : std::runtime_error {
  ProgramInterrupted(const std::string& text, int number) : std::runtime_error(text), signal(number) {}
  int signal;
};

/// The source files of a program, as the user named them.
struct ProgramSources {
  std::vector<std::filesystem::path> files;            ///< that with main() first
  std::vector<std::filesystem::path> include_folders;  ///< -I
};
/// A program that is compiled and run.
struct ProgramTask {
  ProgramSources sources;
  std::string compiler{};        ///< "": $CXX, else c++, g++ or clang++
  std::function<bool()> go_on;   ///< asked now and then; false gives up; may be empty
  bool watch_signals = true;     ///< SIGINT, SIGTERM and SIGHUP end it; false where a window watches them
  bool trusted = false;          ///< it is also run where the system has no guard
  std::string name{};            ///< what messages call it
  std::filesystem::path folder;  ///< of temporary files, that exists; a whole path without links
};

/// The plan under guard: what is run can change nothing outside the task's folder. Throws UsageError where the system
/// has no guard, and the program is not trusted.
ChildPlan guarded(const ProgramTask& task, ChildPlan plan);

/// Runs it so to its end. doing: "it ran", for messages. Throws ProgramInterrupted, too.
ChildEnd run_guarded(const ProgramTask& task, ChildPlan plan, const std::string& doing);

}  // namespace tyndall
