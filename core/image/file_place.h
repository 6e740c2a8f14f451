#pragma once
#include "core/image/image.h"
#include "core/system/files.h"

#include <filesystem>
#include <string>

/// How a file can get new bytes: found out before they are made.
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
  unsigned mode = 0;  ///< of the file that exists
  FileOwner owner;
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

}  // namespace tyndall
