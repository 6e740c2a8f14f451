#pragma once
#include <filesystem>
#include <functional>
#include <memory>

/// Notices that another program has written a file.
namespace tyndall {

/// Tells when a file was written or replaced. Watches its folder, since editors write a new file and rename it.
class FileWatch {
 public:
  /// on_change: called from a thread of the watch; must be quick. Where files cannot be watched (no inotify, no such
  /// folder) nothing is ever told.
  FileWatch(const std::filesystem::path& file, std::function<void()> on_change);
  ~FileWatch();
  FileWatch(const FileWatch&) = delete;
  FileWatch& operator=(const FileWatch&) = delete;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace tyndall
