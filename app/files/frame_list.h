#pragma once
#include <filesystem>
#include <map>
#include <string>

/// A list beside numbered pictures of formats that carry no settings: which frames are whole, and what they are of.
namespace tyndall {

/// Lines are only ever added, so that several machines can write into one list, and a line that was cut off by a kill
/// costs one frame: "3 begun 0123456789abcdef" before the frame's file is written, "3 whole 0123456789abcdef" after it.
class FrameList {
 public:
  struct Entry {
    std::string mark;  ///< 16 hexadecimal digits: what the frame is of
    bool whole = false;
  };

  FrameList() = default;
  /// Reads the list, which need not be there.
  explicit FrameList(std::filesystem::path file);

  const std::filesystem::path& file() const { return file_; }
  /// What the list says of a frame; null: nothing.
  const Entry* find(int frame) const;
  /// Throws IoError.
  void add(int frame, const Entry& entry);

 private:
  std::filesystem::path file_;
  std::map<int, Entry> entries_;
};

}  // namespace tyndall
