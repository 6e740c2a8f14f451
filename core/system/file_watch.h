#pragma once
#include "core/system/files.h"
#include "core/system/locks.h"

#include <filesystem>
#include <functional>
#include <vector>

namespace tyndall {

/// Tells when any of some files may hold something else than before: it was written in place, replaced by renaming,
/// removed, or came back; also where it is reached through symbolic links, one of which may lead elsewhere now. It asks
/// the system some times a second for what each file is and when it was changed, which takes no processor time to
/// speak of, works for files of other machines, too, and can miss nothing that stays.
class FileWatch {
 public:
  /// files: need not exist. on_change: called from a thread of the watch; must be quick. It is called when the files
  /// have been the same for a moment, as many programs write a file in parts, or remove it and write it anew.
  FileWatch(const std::vector<std::filesystem::path>& files, std::function<void()> on_change);
  ~FileWatch();

 private:
  std::vector<FileTrace> traces() const;
  void look_on();

  std::vector<std::filesystem::path> files_;
  std::function<void()> on_change_;
  std::vector<FileTrace> seen_;
  Mutex mutex_;
  Condition wake_;
  bool stops_ = false;
  JoinedThread thread_;  // declared last, because it uses the others
};

}  // namespace tyndall
