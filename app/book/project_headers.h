#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace tyndall {

/// The headers of a program in the folder of its main() and below, also beside that if it is called src or the like.
/// They are listed when one is asked for.
class ProjectHeaders {
 public:
  explicit ProjectHeaders(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// A header in any of the folders, whatever its capitals: build files name folders, and not all systems tell capitals
  /// from small letters. The nearest one; empty: there is none.
  std::filesystem::path find(const std::string& name);

 private:
  void list();

  std::filesystem::path folder_;
  std::vector<std::filesystem::path> headers_;
  bool listed_ = false;
};

}  // namespace tyndall
