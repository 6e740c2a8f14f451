#pragma once
#include "tests/support/paths.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

/// Files that tests write.
namespace tyndall {

/// An empty folder of this name, for one test case.
inline std::filesystem::path scratch_folder(const std::string& name) {
  const std::filesystem::path folder = scratch_folder() / "files" / name;
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

inline std::size_t count_files(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(
      std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator()));
}

}  // namespace tyndall

namespace tyndall::test {

inline std::string read_text(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

}  // namespace tyndall::test
