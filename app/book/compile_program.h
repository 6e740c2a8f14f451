#pragma once
#include "app/book/run_guarded.h"

#include <filesystem>
#include <string>
#include <vector>

namespace tyndall {

struct CompiledProgram {
  std::filesystem::path file;
  std::vector<std::filesystem::path> sources;         ///< the reader's files that were read
  bool draws_by_pdf = false, decodes_images = false;  ///< see InsertedCalls
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
