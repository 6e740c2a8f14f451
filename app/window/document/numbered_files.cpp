#include "app/window/document/numbered_files.h"

#include <fmt/core.h>

#include <sys/file.h>
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <exception>
#include <utility>

namespace tyndall {

namespace fs = std::filesystem;

fs::path numbered_base(const fs::path& folder, const std::string& stem, int minimum,
                       const std::vector<const char*>& endings) {
  for (int number = minimum;; ++number) {
    fs::path base = folder / fmt::format("{}-{:03}", stem, number);
    std::error_code ignored;
    const auto taken = [&](const char* ending) {
      return fs::symlink_status(base.string() + ending, ignored).type() != fs::file_type::not_found;
    };
    if (std::none_of(endings.begin(), endings.end(), taken)) return base;
  }
}

int number_of(const fs::path& base) {
  const std::string name = base.filename().string();
  return std::atoi(name.c_str() + name.rfind('-') + 1);
}

fs::path NumberedFiles::next_base(const std::string& stem) {
  std::error_code gone;  // the current folder may be; writing then says so
  fs::path base = numbered_base(fs::current_path(gone), stem, last_ + 1, endings_);
  last_ = number_of(base);
  return base;
}

namespace {

/// Keeps other windows from choosing a name in the folder while this lives. Where folders cannot be locked it does not.
class FolderLock {
 public:
  explicit FolderLock(const fs::path& folder) : folder_(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    while (folder_ >= 0 && flock(folder_, LOCK_EX) != 0 && errno == EINTR) continue;
  }
  ~FolderLock() {
    if (folder_ >= 0) close(folder_);
  }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int folder_;
};

}  // namespace

void NumberedFiles::write(const fs::path& base, std::function<std::string(const fs::path& base)> work) {
  jobs_.run([this, base, work = std::move(work)]() -> JobQueue::Result {
    try {
      const FolderLock lock(base.parent_path());
      const std::string name = base.filename().string();
      const fs::path free =
          numbered_base(base.parent_path(), name.substr(0, name.rfind('-')), number_of(base), endings_);
      const std::string text = work(free);
      return [this, text, free] {
        last_ = std::max(last_, number_of(free));
        messages_.say(text);
        if (log_) log_->line("saved " + free.string());
      };
    } catch (const std::exception& error) {
      return [this, text = std::string(error.what())] { messages_.say(text, true); };
    }
  });
}

}  // namespace tyndall
