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
  double seconds = 20;           ///< that it may run before its first ray
  std::string name{};            ///< what messages call it
  std::filesystem::path folder;  ///< of temporary files, that exists; a whole path without links
};

/// The plan under guard: what is run can change nothing outside the task's folder. Throws UsageError where the system
/// has no guard, and the program is not trusted.
ChildPlan guarded(const ProgramTask& task, ChildPlan plan);

/// Runs it so to its end. doing: "it ran", for messages. Throws ProgramInterrupted, too.
ChildEnd run_guarded(const ProgramTask& task, ChildPlan plan, const std::string& doing);

struct CompiledProgram {
  std::filesystem::path file;
  std::vector<std::filesystem::path> sources;  ///< the reader's files that were read
};

/// Compiles the program, with its own headers, and our calls in its functions, as C++17, else as C++20. It is
/// preprocessed where it lies; nothing is copied. Source files beside headers belong to it. Throws UsageError with the
/// first error of the reader's code, or where there is nothing to be asked; IoError where there is no compiler or it
/// fails by itself; and as run_guarded() does.
CompiledProgram compile_program(const ProgramTask& task);

/// The first error that a compiler tells of, in one line: "main.cc:3:7: ...". Files are named as the user names main,
/// or from its folder.
std::string first_error(const std::string& output, const std::filesystem::path& main);

}  // namespace tyndall
