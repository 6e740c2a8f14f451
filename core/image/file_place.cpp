#include "core/image/file_place.h"

#include "core/image/image_io_file.h"
#include "core/system/mounts.h"

#include <sys/stat.h>
#include <fcntl.h>
#include <unistd.h>

#ifdef __linux__
#include <linux/magic.h>
#include <sys/statfs.h>
#endif

#include <cerrno>
#include <fstream>
#include <system_error>

namespace tyndall {
namespace {

namespace fs = std::filesystem;

std::string message(int error) { return std::generic_category().message(error); }

fs::path folder_of(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : fs::path("."); }

/// Whether the link stands for a file that is open, not for a name: those of /proc/self/fd, which /dev/stdout leads to.
bool is_open_file(const fs::path& link) {
#ifdef __linux__
  struct statfs system {};
  return statfs(folder_of(link).c_str(), &system) == 0 && system.f_type == PROC_SUPER_MAGIC;
#else
  return link.string().starts_with("/dev/");
#endif
}

/// Follows symbolic links to a name that is none, or to one that stands for an open file.
fs::path end_of_links(const fs::path& file) {
  fs::path target = file;
  std::error_code error;
  for (int links = 0; fs::is_symlink(target, error) && !is_open_file(target); ++links) {
    if (links == 40) cannot_write(file, message(ELOOP));
    target = target.parent_path() / fs::read_symlink(target, error);
    if (error) cannot_write(file, error.message());
  }
  return target;
}

/// Whether files may be renamed and removed that only their owner or that of a sticky folder may. uid: of the file. A
/// process that is privileged among some users only sees the others as one that nobody is.
bool overrides_owner([[maybe_unused]] unsigned uid) {
  constexpr unsigned nobody = 65534;
  constexpr unsigned long long cap_fowner = 1ULL << 3;
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("CapEff:"))
      return uid != nobody && (std::strtoull(line.c_str() + 7, nullptr, 16) & cap_fowner) != 0;
  return geteuid() == 0;
}

/// What the file system lets nobody do with a file or folder (chattr +a and +i), as the end of "it may ..."; "":
/// nothing.
std::string protection_of([[maybe_unused]] const fs::path& file) {
#ifdef STATX_ATTR_APPEND
  struct statx status {};
  if (statx(AT_FDCWD, file.c_str(), 0, 0, &status) != 0) return "";
  if ((status.stx_attributes & STATX_ATTR_IMMUTABLE) != 0) return "not be changed";
  if ((status.stx_attributes & STATX_ATTR_APPEND) != 0) return "only be appended to";
#endif
  return "";
}

/// What keeps the ordinary file at place.target from being replaced; "": nothing that is known beforehand.
std::string obstacle_of(const FilePlace& place) {
  if (is_mount_point(place.target)) return "it is a mount point";
  if (const std::string only = protection_of(place.target); !only.empty()) return "it may " + only;
  if (!place.folder_problem.empty()) return place.folder_problem;
  struct stat folder {};
  if (stat(place.folder.c_str(), &folder) != 0 || (folder.st_mode & S_ISVTX) == 0) return "";
  const unsigned me = geteuid();
  const bool may = place.user == me || folder.st_uid == me || overrides_owner(place.user);
  return may ? "" : "it is another user's file in a folder with the sticky bit";
}

}  // namespace

FilePlace find_place(const fs::path& file) {
  FilePlace place;
  place.method = file == "-" ? WriteMethod::stream : WriteMethod::replace;
  place.target = file;
  if (file == "-") return place;
  struct stat status {};
  const bool there = stat(file.c_str(), &status) == 0;
  if (!there && errno != ENOENT) cannot_write(file, message(errno));
  place.target = end_of_links(file);
  place.folder = folder_of(place.target);
  if (!place.target.has_filename()) cannot_write(file, message(EISDIR));
  if (const std::string only = protection_of(place.folder); !only.empty())
    place.folder_problem = "its folder may " + only;
  if (!there && !place.folder_problem.empty()) cannot_write(file, place.folder_problem);
  if (!there) return place;
  place.exists = true;
  place.mode = status.st_mode & 07777u, place.user = status.st_uid, place.group = status.st_gid;
  if (S_ISDIR(status.st_mode)) cannot_write(file, message(EISDIR));
  std::error_code error;
  const bool once = S_ISFIFO(status.st_mode) || S_ISCHR(status.st_mode) || fs::is_symlink(place.target, error);
  if (!once && !S_ISREG(status.st_mode)) cannot_write(file, "not an ordinary file");
  if (once && access(file.c_str(), W_OK) != 0) cannot_write(file, message(errno));
  if (once) place.method = WriteMethod::stream;
  if (!once) place.obstacle = obstacle_of(place);
  if (!place.obstacle.empty()) place.method = WriteMethod::in_place;
  return place;
}

bool is_stream(const fs::path& file) {
  if (file == "-") return true;
  std::error_code error;
  const fs::file_type type = fs::status(file, error).type();
  if (type == fs::file_type::fifo || type == fs::file_type::character) return true;
  try {
    return type == fs::file_type::regular && find_place(file).method == WriteMethod::stream;
  } catch (const ImageFileError&) {
    return false;  // writing it says why
  }
}

fs::path beside(const fs::path& file, const std::string& mark) {
  return file.parent_path() / (file.stem().string() + "." + mark + file.extension().string());
}

}  // namespace tyndall
