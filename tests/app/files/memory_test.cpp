#include "app/files/memory.h"

#include "core/base/error.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

namespace tyndall::test::memory_test {
namespace fs = std::filesystem;

TEST_CASE("memory: what the process's own group may still take is known, not only what the topmost group may") {
  const fs::path root = scratch_folder("memory_group");
  fs::create_directories(root / "proc/self");
  write_text(root / "proc/self/mountinfo",
             "30 22 0:29 / /sys/fs/cgroup rw - cgroup2 cgroup2 rw\n"
             "31 22 0:30 / /sys/fs/cgroup/memory rw - cgroup cgroup rw,memory\n");
  write_text(root / "proc/self/cgroup", "4:memory:/jobs\n0::/system.slice/job.scope\n");
  const fs::path group = root / "sys/fs/cgroup/system.slice";
  fs::create_directories(group / "job.scope");
  const std::uint64_t before = free_memory(root).bytes;
  write_text(group / "job.scope/memory.max", "max\n");
  CHECK(free_memory(root).bytes > before / 2);
  write_text(group / "memory.max", "3000000\n");
  write_text(group / "memory.current", "1000000\n");
  CHECK(free_memory(root).bytes == 2000000);
  CHECK(free_memory(root).limit == "left to this group of processes (cgroup)");
  const fs::path old = root / "sys/fs/cgroup/memory/jobs";
  fs::create_directories(old);
  write_text(old / "memory.limit_in_bytes", "1500000\n");
  write_text(old / "memory.usage_in_bytes", "1400000\n");
  CHECK(free_memory(root).bytes == 100000);
}

TEST_CASE("memory: films that are read beside their sum, copies for checkpoints and clean views are counted") {
  MemoryPlan plan{.width = 100, .height = 100};
  const FreeMemory enough{11'000'000 + 10'000 * (bytes_per_pixel(false) + 25), "here"};
  CHECK_NOTHROW(check_memory(plan, enough));
  CHECK_THROWS_AS(check_memory(plan, {enough.bytes - 1, "here"}), UsageError);
  for (const auto counted : {&MemoryPlan::parts, &MemoryPlan::checkpoints, &MemoryPlan::clean, &MemoryPlan::window}) {
    plan.*counted = true;
    CHECK_THROWS_AS(check_memory(plan, enough), UsageError);
    plan.*counted = false;
  }
}

}  // namespace tyndall::test::memory_test
