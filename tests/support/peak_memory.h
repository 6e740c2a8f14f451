#pragma once
#include <cstdint>
#include <fstream>
#include <malloc.h>
#include <string>

/// How much memory an action needs at most.
namespace tyndall::test {

/// A figure of this process in bytes, by its name in /proc/self/status: VmRSS (memory now), VmHWM (the most so far).
inline std::int64_t process_memory(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(name + ":")) return std::stoll(line.substr(name.size() + 1)) * 1024;
  return 0;
}

/// The most memory in bytes that this process has during the action beyond what it has before. 0 where that is not
/// known: without glibc, and with the sanitizer of addresses, which keeps what was freed.
template <class Action>
std::int64_t peak_memory_of(Action action) {
#if defined(__SANITIZE_ADDRESS__) || !defined(__GLIBC__)
  action();
  return 0;
#else
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << 5;  // forgets the most so far
  const std::int64_t before = process_memory("VmRSS");
  action();
  return process_memory("VmHWM") - before;
#endif
}

}  // namespace tyndall::test
