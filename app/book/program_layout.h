#pragma once
#include "app/book/definitions.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tyndall {

/// The source files of a program, as the user named them.
struct ProgramSources {
  std::vector<std::filesystem::path> files;            ///< that with main() first
  std::vector<std::filesystem::path> include_folders;  ///< -I
};

/// What decides where balls lie that a program places at random, in place of what its source and the user choose.
struct ProgramBuild {
  std::string compiler;  ///< "": $CXX, else c++, g++ or clang++
  /// Options for the compiler that choose the generator: see tyndall/book/parts/random.h. Absent: the program's.
  std::optional<std::vector<std::string>> random{};
};

/// A class of the reader's own in a header that one of ours takes the place of.
struct OwnClass {
  std::string base, file;
};

/// A header of the reader's, or a source file that belongs to one.
struct OwnHeader {
  std::string shown;  ///< what messages call it
  std::vector<Definition> definitions;
  std::vector<Definition> book_classes{};  ///< in whose place ours stand
};

/// A program as it is compiled: its files with other includes. Those of the books' headers lead to ours, those of the
/// reader's other headers to copies, so that a sphere.h beside main.cc is never found. Each begins with a #line, so
/// that the compiler's messages name the reader's file.
struct ProgramLayout {
  std::map<std::string, std::string> texts;      ///< by the file's name in the folder where it is compiled
  std::vector<std::string> compiled_files;       ///< those of the texts that are compiled
  std::vector<std::string> further_files;        ///< source files beside own headers, if something is missing
  std::vector<std::string> shown_names;          ///< what messages call the files
  std::vector<std::filesystem::path> files;      ///< all of the reader's that were read
  std::map<std::string, OwnClass> own_classes;   ///< by name
  std::vector<OwnHeader> replaced;               ///< in whose place ours stand; what one includes comes before it
  std::map<std::string, OwnHeader> own_headers;  ///< the others, by their names among the texts
  std::vector<std::filesystem::path> data;       ///< files beside the program that its strings name, relative to it
  std::vector<std::string> options;              ///< for the compiler: see tyndall/book/parts/random.h
  std::string sky;                               ///< of a camera that sets no background, JSON; empty: the book's
  bool unknown_sky = false;                      ///< the reader's camera.h has another one, which cannot be told
};

/// Texts of a layout: what includes of the books' headers lead to, and what OwnNames fills.
constexpr const char *our_headers = "our_headers.h", *own_names = "own_names.h";

/// A string of C++, without its quotes.
std::string escaped(const std::string& text);

/// Reads the program. headers: the folder of ours. Throws IoError for a file that cannot be read, UsageError if the
/// program includes none of the books' headers.
ProgramLayout lay_out(const ProgramSources& sources, const std::filesystem::path& headers);

}  // namespace tyndall
