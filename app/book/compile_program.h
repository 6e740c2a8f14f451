#pragma once
#include "app/book/program_layout.h"
#include "app/book/run_guarded.h"

#include <string>

namespace tyndall {

/// Compiles a program whose texts are in the folder `code` of the task's. include_folders: whole paths. By $CXX, else
/// by c++, g++ or clang++, as C++17, else as C++20. Throws UsageError with the first error of the reader's code,
/// IoError where there is no compiler or it fails by itself, and as run_guarded() does.
void compile_program(const ProgramTask& task, const ProgramLayout& layout,
                     const std::vector<std::filesystem::path>& include_folders, const std::filesystem::path& program);

/// The name between the first quotes of a message of GCC's or Clang's; "": there is none.
std::string quoted_name(const std::string& message);

/// The class of ours that a class derived from `base` is a kind of: hittable, material, texture; null: none.
const char* kind_of_base(const std::string& base);
/// Likewise, where `base` may also be one of the books' shapes, materials or textures.
const char* kind_of_book_class(const std::string& base);

/// The first error that the compiler tells of, in one line: "main.cc:3:7: ...", at the place in the reader's own files.
/// A class of the reader's that ours have no place for is named instead.
std::string first_error(const std::string& output, const ProgramLayout& layout);

}  // namespace tyndall
