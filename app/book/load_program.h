#pragma once
#include "app/book/compile_program.h"
#include "app/book/own_program.h"

#include <string>

/// Programs of readers of "Ray Tracing in One Weekend", compiled with their own headers.
namespace tyndall {

/// Whether the name is a C++ source file's: it ends in .cc, .cpp or .cxx.
bool is_program(const std::string& name);

/// Compiles the program and runs it in its folder until it asks for the colour of its first ray; then its world is
/// read. It can change nothing outside a temporary folder, unless there is no guard and it is trusted. This runs the
/// reader's code: only for files that the user has named. The task's name and folder are found here. Throws UsageError
/// where there is nothing to show, IoError where the system fails, ProgramInterrupted; all in one line.
ProgramScene load_program(const ProgramTask& task);

}  // namespace tyndall
