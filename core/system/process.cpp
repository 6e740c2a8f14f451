#include "core/system/process.h"

#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <sstream>
#include <system_error>

namespace tyndall {
namespace {

/// The number in the first line of a file of the system that begins with `key`, in bytes if it is in kB; no_limit:
/// there is none.
std::uint64_t system_number(const std::filesystem::path& file, const std::string& key, std::uint64_t unit = 1) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with(key)) continue;
    const std::size_t digits = line.find_first_of("0123456789", key.size());
    return digits == line.npos ? no_limit : unit * std::strtoull(line.c_str() + digits, nullptr, 10);
  }
  return no_limit;
}

/// Spaces and the like are written there as a backslash and three octal digits.
std::string unescaped(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool code = text[i] == '\\' && i + 3 < text.size();
    out += code ? static_cast<char>(std::strtol(text.substr(i + 1, 3).c_str(), nullptr, 8)) : text[i];
    if (code) i += 3;
  }
  return out;
}

std::optional<Mount> mount_of(const std::string& line) {
  Mount mount;
  std::istringstream words(line);
  std::string word;
  words >> word >> word >> word >> mount.root >> mount.point;
  while (words >> word && word != "-") continue;  // optional fields
  words >> mount.type >> word >> mount.options;
  mount.root = unescaped(mount.root), mount.point = unescaped(mount.point);
  return mount.options.empty() || !mount.point.starts_with('/') ? std::nullopt : std::optional(mount);
}

bool names(const std::string& list, const std::string& word) {
  return ("," + list + ",").find("," + word + ",") != std::string::npos;
}

/// The group's path as a line of proc/self/cgroup has it ("3:cpu,cpuacct:/a/b"; "0::/a/b" for version 2), if the line
/// is of the hierarchy that is mounted.
std::optional<std::string> group_in(const std::string& line, const Mount& mount, const std::string& controller) {
  const std::size_t first = line.find(':'), second = line.find(":/", first + 1);
  if (first == line.npos || second == line.npos) return std::nullopt;
  const std::string controllers = line.substr(first + 1, second - first - 1);
  const bool fits = mount.type == "cgroup2" ? controllers.empty() : names(controllers, controller);
  return fits ? std::optional(line.substr(second + 1)) : std::nullopt;
}

/// The part of the path that lies below the mounted root; "": the group is the root, or cannot be seen here.
std::string below(const std::string& group, const std::string& root) {
  if (group.find("/..") != std::string::npos) return "";
  if (root == "/") return group.substr(1);
  return group.starts_with(root + "/") ? group.substr(root.size() + 1) : "";
}

std::uint64_t less(std::uint64_t limit, std::uint64_t used) {
  return limit == no_limit ? no_limit : limit - std::min(limit, used);
}

}  // namespace

void begin_process() {
  std::signal(SIGXFSZ, SIG_IGN);
  int descriptor = -1;
  do descriptor = open("/dev/null", O_RDONLY);  // the lowest that is free; for reading only: writing fails
  while (descriptor >= 0 && descriptor <= STDERR_FILENO);
  if (descriptor >= 0) close(descriptor);
}

std::vector<std::string> program_arguments(int argc, char** argv) { return {argv + (argc > 0 ? 1 : 0), argv + argc}; }

bool is_terminal(int descriptor) { return isatty(descriptor) != 0; }

bool has_smart_terminal() {
  const char* term = std::getenv("TERM");
  return is_terminal(STDERR_FILENO) && term && std::string(term) != "dumb";
}

bool has_display() {
#ifdef __APPLE__
  return true;
#else
  return is_set("DISPLAY") || is_set("WAYLAND_DISPLAY");
#endif
}

int terminal_columns() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

void ask_for_large_pages([[maybe_unused]] void* begin, [[maybe_unused]] std::size_t bytes) {
#ifdef MADV_HUGEPAGE
  madvise(begin, bytes, MADV_HUGEPAGE);
#endif
}

void* allocate_aligned(std::size_t bytes, std::size_t alignment) {
  void* memory = nullptr;
  return posix_memalign(&memory, alignment, bytes) == 0 ? memory : nullptr;
}

std::uint64_t limit_of(Limit limit) {
  rlimit found{};
  const auto resource = limit == Limit::address_space ? RLIMIT_AS : (limit == Limit::data ? RLIMIT_DATA : RLIMIT_NPROC);
  return getrlimit(resource, &found) != 0 || found.rlim_cur == RLIM_INFINITY ? no_limit : found.rlim_cur;
}

std::vector<Mount> mounts(const std::filesystem::path& root) {
  std::vector<Mount> found;
  std::ifstream in(root / "proc/self/mountinfo");
  for (std::string line; std::getline(in, line);)
    if (const auto mount = mount_of(line)) found.push_back(*mount);
  return found;
}

bool is_mount_point(const std::filesystem::path& file) {
#ifdef STATX_ATTR_MOUNT_ROOT
  struct statx status {};
  const bool known = statx(AT_FDCWD, file.c_str(), 0, 0, &status) == 0;
  if (known && (status.stx_attributes_mask & STATX_ATTR_MOUNT_ROOT) != 0)
    return (status.stx_attributes & STATX_ATTR_MOUNT_ROOT) != 0;
#endif
  std::error_code error;  // an older system, which does not say it of a file
  const std::filesystem::path place = std::filesystem::canonical(file, error);
  const std::vector<Mount> all = error ? std::vector<Mount>() : mounts();
  return std::any_of(all.begin(), all.end(), [&](const Mount& mount) { return mount.point == place; });
}

std::vector<std::filesystem::path> cgroup_folders(const std::string& controller, const std::filesystem::path& root) {
  std::vector<std::filesystem::path> folders;
  for (const Mount& mount : mounts(root)) {
    const bool version_1 = mount.type == "cgroup" && names(mount.options, controller);
    if (!version_1 && mount.type != "cgroup2") continue;
    const std::filesystem::path top = root / mount.point.substr(1);
    std::ifstream groups(root / "proc/self/cgroup");
    for (std::string line; std::getline(groups, line);) {
      const auto group = group_in(line, mount, controller);
      if (!group) continue;
      for (std::filesystem::path rest = below(*group, mount.root); !rest.empty(); rest = rest.parent_path())
        folders.push_back(top / rest);
      folders.push_back(top);
    }
  }
  return folders;
}

FreeMemory free_memory(const std::filesystem::path& root) {
  FreeMemory free{system_number("/proc/meminfo", "MemAvailable:", 1024), "free on this machine"};
  const std::uint64_t swap = system_number("/proc/meminfo", "SwapFree:", 1024);
  if (free.bytes != no_limit && swap != no_limit) free.bytes += swap;
  const auto at_most = [&free](std::uint64_t bytes, const char* limit) {
    if (bytes < free.bytes) free = {bytes, limit};
  };
  for (const std::filesystem::path& group : cgroup_folders("memory", root)) {
    constexpr const char* files[][2] = {{"memory.max", "memory.current"},
                                        {"memory.limit_in_bytes", "memory.usage_in_bytes"}};
    for (const auto& [limit, used] : files)
      at_most(less(system_number(group / limit, ""), system_number(group / used, "")),
              "left to this group of processes (cgroup)");
  }
  at_most(less(limit_of(Limit::address_space), system_number("/proc/self/status", "VmSize:", 1024)),
          "left by ulimit -v");
  at_most(less(limit_of(Limit::data), system_number("/proc/self/status", "VmData:", 1024)), "left by ulimit -d");
  return free;
}

std::size_t peak_memory() {
  // ru_maxrss also counts the program that started this one (before exec); VmHWM of the kernel does not.
  const std::uint64_t peak = system_number("/proc/self/status", "VmHWM:", 1024);
  if (peak != no_limit) return peak;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
#ifdef __APPLE__
  return static_cast<std::size_t>(usage.ru_maxrss);  // bytes, there
#else
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
#endif
}

void lower_priority([[maybe_unused]] int niceness) {
#ifdef __linux__
  setpriority(PRIO_PROCESS, 0, niceness);
#endif
}

double thread_cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

void* loaded_function(const char* library, const char* name) {
  void* loaded = dlopen(library, RTLD_LAZY | RTLD_NOLOAD);
  return loaded ? dlsym(loaded, name) : nullptr;
}

}  // namespace tyndall
