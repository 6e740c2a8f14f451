#include "core/system/files.h"

#include <sys/stat.h>
#include <dirent.h>
#include <fcntl.h>
#include <unistd.h>
#ifdef __GLIBC__
#include <dlfcn.h>
#include <link.h>
#endif

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <system_error>

namespace tyndall {
namespace {

namespace fs = std::filesystem;

/// Whether files may be renamed and removed that only their owner or that of a sticky folder may. user: of the file. A
/// process that is privileged among some users only sees the others as one that nobody is.
bool overrides_owner(unsigned user) {
  constexpr unsigned nobody = 65534;
  constexpr unsigned long long cap_fowner = 1ULL << 3;
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("CapEff:"))
      return user != nobody && (std::strtoull(line.c_str() + 7, nullptr, 16) & cap_fowner) != 0;
  return geteuid() == 0;
}

}  // namespace

std::vector<std::string> names_in_folder(const fs::path& folder) {
  std::vector<std::string> names;
  const auto close = [](DIR* open) { closedir(open); };
  const std::unique_ptr<DIR, decltype(close)> entries(opendir(folder.c_str()), close);
  for (const dirent* entry = nullptr; entries && (entry = readdir(entries.get())) != nullptr;)
    names.emplace_back(entry->d_name);
  return names;
}

std::size_t longest_name(const fs::path& folder) {
  const long longest = pathconf(folder.c_str(), _PC_NAME_MAX);
  return longest > 64 ? static_cast<std::size_t>(longest) : 255;
}

fs::path temporary_folder() {
  const char* chosen = std::getenv("TMPDIR");
  return chosen && *chosen ? chosen : "/tmp";
}

fs::path make_temporary_folder(const std::string& begin, int* error) {
  std::string folder = (temporary_folder() / (begin + "XXXXXX")).string();
  const bool made = mkdtemp(folder.data());
  if (error) *error = made ? 0 : errno;
  return made ? fs::path(folder) : fs::path();
}

void remove_file(const fs::path& file) { unlink(file.c_str()); }

int replace_file(const fs::path& from, const fs::path& to) {
  return std::rename(from.c_str(), to.c_str()) == 0 ? 0 : errno;
}

std::FILE* open_stream(const fs::path& file, const char* mode) { return std::fopen(file.c_str(), mode); }

std::string problem_of_name(const fs::path&) { return ""; }

FileTrace trace_of(const fs::path& file) {
  struct stat s {};
  if (stat(file.c_str(), &s) != 0) return {};
  const auto time = [](const timespec& t) { return t.tv_sec * std::int64_t{1'000'000'000} + t.tv_nsec; };
  return {static_cast<std::int64_t>(s.st_dev), static_cast<std::int64_t>(s.st_ino), s.st_size, time(s.st_mtim),
          time(s.st_ctim)};
}

fs::path own_file() {
  std::error_code error;
#ifdef __GLIBC__
  Dl_info found{};
  void* map = nullptr;
  if (dladdr1(reinterpret_cast<void*>(&own_file), &found, &map, RTLD_DL_LINKMAP) != 0) {
    const char* library = static_cast<const link_map*>(map)->l_name;  // "" of the program itself
    if (library && *library) return fs::canonical(library, error);
  }
#endif
  return fs::read_symlink("/proc/self/exe", error);
}

fs::path home_folder() {
  const char* home = std::getenv("HOME");
  const fs::path folder = home ? home : "";
  return folder.is_absolute() ? folder : fs::path();
}

fs::path folder_of_user(const std::string& below_home) {
  const fs::path home = home_folder();
  return home.empty() ? home : home / below_home;
}

bool is_open_file(const fs::path& link) {
  std::error_code error;
  return fs::canonical(link.has_parent_path() ? link.parent_path() : ".", error).string().starts_with("/proc/");
}

std::string protection_of([[maybe_unused]] const fs::path& file) {
#ifdef STATX_ATTR_APPEND
  struct statx status {};
  if (statx(AT_FDCWD, file.c_str(), 0, 0, &status) != 0) return "";
  if ((status.stx_attributes & STATX_ATTR_IMMUTABLE) != 0) return "not be changed";
  if ((status.stx_attributes & STATX_ATTR_APPEND) != 0) return "only be appended to";
#endif
  return "";
}

bool is_kept_by_sticky_folder(const fs::path& file, const fs::path& folder) {
  struct stat status {
  }, of_file{};
  if (stat(folder.c_str(), &status) != 0 || (status.st_mode & S_ISVTX) == 0) return false;
  if (stat(file.c_str(), &of_file) != 0) return false;
  const unsigned me = geteuid();
  return of_file.st_uid != me && status.st_uid != me && !overrides_owner(of_file.st_uid);
}

int writing_error(const fs::path& file) { return access(file.c_str(), W_OK) == 0 ? 0 : errno; }

}  // namespace tyndall
