#pragma once
#include <filesystem>
#include <string>

namespace tyndall {

/// An empty folder among the temporary files ($TMPDIR, else /tmp), only for this user; removed with all that is in it.
class ScratchFolder {
 public:
  /// Throws IoError if it cannot be made.
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Writes a file in it, and the folders above it. Throws IoError.
  void write(const std::filesystem::path& name, const std::string& text) const;

 private:
  std::filesystem::path path_;
};

/// Writes a text file, and the folders above it. Throws IoError.
void write_text(const std::filesystem::path& file, const std::string& text);
/// A text file. Throws IoError if it cannot be read, or is no ordinary file.
std::string read_text(const std::filesystem::path& file);

}  // namespace tyndall
