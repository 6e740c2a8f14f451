#pragma once
#include <filesystem>
#include <string>
#include <vector>

/// Programs that are run and measured as a whole.
namespace tyndall::bench {

/// The program "tyndall" beside this one, or in the folder above; empty if there is none.
std::filesystem::path find_tyndall();

/// Runs a program with its output thrown away and waits for it; answers whether it ended well.
bool run_process(std::vector<std::string> arguments);

/// A folder of our own that goes with its contents. Throws std::runtime_error if none can be made.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace tyndall::bench
