#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

/// Notices that another program has written a file.
namespace tyndall {

/// Tells when any of some files may hold something else than before: it was written in place, replaced by renaming,
/// removed, or came back. Also where the file is reached through symbolic links, whether the file was written that they
/// lead to or one of them leads elsewhere now, and where one of its folders was removed or replaced.
class FileWatch {
 public:
  /// files: need not exist. on_change: called from a thread of the watch; must be quick. A file that is gone is told of
  /// a tenth of a second later, as many programs remove a file and write it anew. What cannot be watched (see
  /// problem()) is not told of.
  FileWatch(const std::vector<std::filesystem::path>& files, std::function<void()> on_change);
  ~FileWatch();

  /// Why the file cannot be watched; "": it is.
  const std::string& problem() const { return problem_; }

 private:
  struct State;
  std::unique_ptr<State> state_;
  std::string problem_;
};

}  // namespace tyndall
