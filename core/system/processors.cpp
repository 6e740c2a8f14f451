#include "core/system/processors.h"

#include "core/system/process.h"

#ifdef __linux__
#include <sched.h>
#endif

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <fstream>
#include <thread>

namespace tyndall {
namespace {

namespace fs = std::filesystem;

int processors_of_machine() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

/// The processors that the calling thread is bound to.
int processors_of_affinity() {
#ifdef __linux__
  for (std::size_t room = 1024; room <= std::size_t{1} << 20; room *= 2) {
    const std::size_t bytes = CPU_ALLOC_SIZE(room);
    cpu_set_t* set = CPU_ALLOC(room);
    const bool known = set && sched_getaffinity(0, bytes, set) == 0;
    const int error = errno, count = known ? CPU_COUNT_S(bytes, set) : 0;
    CPU_FREE(set);
    if (known) return std::max(1, count);
    if (error != EINVAL) break;  // EINVAL: the machine has more processors than there is room for
  }
#endif
  return processors_of_machine();
}

/// The first numbers in a file; absent: it begins with none, as "max 100000" and missing files do.
struct Numbers {
  std::optional<std::int64_t> first, second;
};
Numbers numbers_in(const fs::path& file) {
  Numbers numbers;
  std::ifstream in(file);
  std::int64_t number = 0;
  if (in >> number) numbers.first = number;
  if (numbers.first && in >> number) numbers.second = number;
  return numbers;
}

/// The quota that one group sets.
std::optional<int> quota_of(const fs::path& folder) {
  Numbers quota = numbers_in(folder / "cpu.max");
  if (!quota.first)
    quota = {numbers_in(folder / "cpu.cfs_quota_us").first, numbers_in(folder / "cpu.cfs_period_us").first};
  const std::int64_t time = quota.first.value_or(0), period = quota.second.value_or(100'000);
  if (time <= 0 || period <= 0) return std::nullopt;  // -1: none
  const std::int64_t rounded_up = time / period + (time % period > 0);
  return static_cast<int>(std::clamp<std::int64_t>(rounded_up, 1, 1 << 20));
}

}  // namespace

std::optional<int> processor_quota(const fs::path& root) {
  std::optional<int> minimum;
  for (const fs::path& folder : cgroup_folders("cpu", root))
    if (const auto quota = quota_of(folder)) minimum = std::min(*quota, minimum.value_or(*quota));
  return minimum;
}

ThreadCount thread_count(int requested, const fs::path& root) {
  if (requested > 0) return {requested, "option"};
  const int machine = processors_of_machine(), bound = std::min(processors_of_affinity(), machine);
  const int quota = processor_quota(root).value_or(bound);
  if (quota < bound) return {quota, "quota"};
  return {bound, bound < machine ? "affinity" : "machine"};
}

}  // namespace tyndall
