#include "core/system/process.h"

#include "core/system/processors.h"

#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <time.h>
#include <unistd.h>

#include <csignal>

namespace tyndall {

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

bool has_display() { return is_set("DISPLAY") || is_set("WAYLAND_DISPLAY"); }

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

std::uint64_t memory_of_machine() {
  const std::uint64_t memory = system_number("/proc/meminfo", "MemAvailable:", 1024);
  const std::uint64_t swap = system_number("/proc/meminfo", "SwapFree:", 1024);
  return memory != no_limit && swap != no_limit ? memory + swap : memory;
}

std::size_t peak_memory() {
  // ru_maxrss also counts the program that started this one (before exec); VmHWM of the kernel does not.
  const std::uint64_t peak = system_number("/proc/self/status", "VmHWM:", 1024);
  if (peak != no_limit) return peak;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
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
