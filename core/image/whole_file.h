#pragma once
#include "core/image/image.h"
#include "core/system/open_file.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

/// The one way in which the program writes files that are to stay: images, films, scenes, figures and charts.
namespace tyndall {

enum class WriteMethod {
  replace,   ///< a whole new file takes its place
  in_place,  ///< nothing can take its place; the new bytes are written into it
  stream     ///< standard output, a named pipe or a device, which takes bytes once
};

/// Where a file is, and how it is written.
struct FilePlace {
  WriteMethod method = WriteMethod::replace;
  std::filesystem::path target;  ///< where the chain of symbolic links ends
  std::filesystem::path folder;  ///< of the target
  std::string obstacle;          ///< what keeps it from being replaced: "it is a mount point"; "": nothing does
  /// Why the folder takes no new files, which is known for certain when a WholeFile was made there; "": it does.
  std::string folder_problem{};
  bool exists = false;
};

/// Looks at a file, which need not exist. "-" is standard output. Nothing is written. Ordinary files are replaced,
/// unless something is mounted at them or the rules of their folder forbid it to this user (the sticky bit of shared
/// folders, files and folders that may not be changed or only be appended to). Throws ImageFileError "FILE: cannot
/// write: WHY" for folders, block devices, sockets, and what may not be written.
FilePlace find_place(const std::filesystem::path& file);

/// True for standard output ("-"), named pipes and devices, and for links to open files such as /dev/stdout.
bool is_stream(const std::filesystem::path& file);

/// "pictures/a.MARK.png" for "pictures/a.png": the name of a file beside another one.
std::filesystem::path beside(const std::filesystem::path& file, const std::string& mark);

/// A file that appears under its name, replacing what was there, only when it is whole and on the disk: whatever ends
/// the program or the machine meanwhile, the old file or the new one is there. All functions throw ImageFileError
/// "FILE: cannot write: WHY".
///
/// The bytes go into a temporary file in the same folder, FILE.tmp- and 16 hexadecimal digits. It is locked as long as
/// its writer lives, so that the next writer of the same file knows which ones a killed process has left, and removes
/// those. The mode of a file that is replaced is kept, and where that is permitted its owner and group. A symbolic link
/// stays, and what it points to is replaced.
///
/// What cannot be replaced (see find_place), or is in a folder that takes no new files, is written into when all bytes
/// are there, after the disk has promised the room. Only then can a crash leave a file that is neither old nor new; an
/// error that does says so.
///
/// Standard output, whose name is "-", named pipes and devices get the bytes when all are there; until then they are in
/// a temporary file without a name. A pipe is opened only then.
class WholeFile {
 public:
  /// Creates the temporary file, and finds out whether the file can be written. Nothing is changed by that.
  explicit WholeFile(const std::filesystem::path& file);
  ~WholeFile();  ///< removes what was written unless it was committed
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  void write(std::span<const std::byte> bytes);
  void seek(std::uint64_t position);
  std::uint64_t position() const { return position_; }
  /// Where the file is, and how commit() will write it.
  const FilePlace& place() const { return place_; }
  /// Puts the file in its place. When it returns, a power cut can no longer take the file away.
  void commit();

 private:
  bool create(const std::filesystem::path& temporary);
  void flush();
  void open_beside();
  void check_in_place();
  void overwrite() const;
  void copy_to(const OpenFile& to) const;
  void check(int error) const;
  [[noreturn]] void fail(int number) const;

  std::filesystem::path file_, temporary_;
  FilePlace place_;
  OpenFile bytes_;                 ///< the temporary file
  std::vector<std::byte> buffer_;  ///< what is to be written next; it ends at position_
  std::uint64_t position_ = 0;
};

}  // namespace tyndall
