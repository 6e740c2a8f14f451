#include "core/system/process.h"

#include "core/system/mounts.h"

#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>

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
  const auto is_set = [](const char* variable) {
    const char* value = std::getenv(variable);
    return value && *value;
  };
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
