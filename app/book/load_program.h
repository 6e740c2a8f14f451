#pragma once
#include "app/book/compile_program.h"
#include "app/book/program_layout.h"

#include <functional>
#include <string>
#include <vector>

namespace tyndall {

/// Whether the name is a C++ source file's: it ends in .cc, .cpp or .cxx.
bool is_program(const std::string& name);

struct ProgramRequest {
  ProgramSources sources;  ///< as the user named them
  ProgramBuild build{};
  double seconds = 20;          ///< that the program may run
  std::function<bool()> go_on;  ///< asked now and then; false gives up; may be empty
  bool watch_signals = true;    ///< see ProgramTask; false where a window watches them
  bool trusted = false;         ///< see ProgramTask
};

/// What a program has described.
struct ProgramScene {
  std::string json;                          ///< a scene file's text, with size, samples and depth
  std::vector<std::string> notes;            ///< what the user should know, a line each
  std::vector<std::filesystem::path> files;  ///< of the reader's, that were read
};

/// Compiles the program and runs it in an empty temporary folder, where it finds copies of the files that its strings
/// name. It can change nothing outside that folder, unless there is no guard and it is trusted. This runs the reader's
/// code: only for files that the user has named. Throws UsageError where the program cannot be taken over, IoError
/// where the system fails, ProgramInterrupted; all in one line.
ProgramScene load_program(const ProgramRequest& request);

}  // namespace tyndall
