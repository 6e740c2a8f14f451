#include "core/system/processors.h"
#include "core/base/thread_pool.h"
#include "core/system/process.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

#include <sched.h>

#include <thread>

namespace tyndall::test::processors_test {
namespace fs = std::filesystem;

namespace {

/// A folder with the files by which a system tells a process its control groups. mounts: lines of mountinfo.
fs::path system_with(const std::string& name, const std::string& groups, const std::string& mounts) {
  const fs::path root = scratch_folder("processors_" + name);
  fs::create_directories(root / "proc/self");
  write_text(root / "proc/self/cgroup", groups);
  write_text(root / "proc/self/mountinfo", "22 1 254:0 / / rw,relatime - ext4 /dev/vda rw\n" + mounts);
  return root;
}

constexpr const char* version_2 = "30 22 0:29 / /sys/fs/cgroup rw,nosuid shared:4 - cgroup2 cgroup2 rw,nsdelegate\n";

void put(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  write_text(file, text);
}

}  // namespace

TEST_CASE("processors: a quota of version 2 is found in the process's group and in those above it; the least counts") {
  const fs::path root = system_with("v2", "0::/batch.slice/job 7\n", version_2);
  const fs::path top = root / "sys/fs/cgroup";
  CHECK_FALSE(processor_quota(root));
  put(top / "batch.slice/job 7/cpu.max", "max 100000\n");
  CHECK_FALSE(processor_quota(root));
  put(top / "batch.slice/cpu.max", "350000 100000\n");
  CHECK(processor_quota(root) == 4);  // rounded up
  put(top / "batch.slice/job 7/cpu.max", "150000 50000\n");
  CHECK(processor_quota(root) == 3);
  put(top / "other.slice/cpu.max", "10000 100000\n");
  CHECK(processor_quota(root) == 3);
  put(top / "batch.slice/cpu.max", "1000 100000\n");
  CHECK(processor_quota(root) == 1);
}

TEST_CASE(
    "processors: a quota of version 1 is found beside a hierarchy of version 2, in groups of several controllers") {
  const std::string mounts =
      "31 22 0:30 / /sys/fs/cgroup/memory rw - cgroup cgroup rw,memory\n"
      "32 22 0:31 / /sys/fs/cgroup/cpu,cpuacct rw shared:9 - cgroup cgroup rw,cpu,cpuacct\n"
      "33 22 0:32 / /sys/fs/cgroup/cpuset rw - cgroup cgroup rw,cpuset\n"
      "34 22 0:33 / /sys/fs/cgroup/unified rw - cgroup2 cgroup2 rw\n";
  const fs::path root =
      system_with("v1", "9:memory:/m\n4:cpu,cpuacct:/jobs/a\n3:cpuset:/jobs/set\n0::/jobs/a\n", mounts);
  const fs::path group = root / "sys/fs/cgroup/cpu,cpuacct/jobs/a";
  put(group / "cpu.cfs_quota_us", "-1\n");
  put(group / "cpu.cfs_period_us", "100000\n");
  CHECK_FALSE(processor_quota(root));
  put(group / "cpu.cfs_quota_us", "250000\n");
  CHECK(processor_quota(root) == 3);
  put(root / "sys/fs/cgroup/cpuset/jobs/set/cpu.cfs_quota_us", "100000\n");  // no file of that controller
  CHECK(processor_quota(root) == 3);
  put(root / "sys/fs/cgroup/unified/jobs/a/cpu.max", "200000 100000\n");
  CHECK(processor_quota(root) == 2);
}

TEST_CASE("processors: in a container the group's path begins above what is mounted, or cannot be seen at all") {
  const std::string part = "30 22 0:29 /docker/abc /sys/fs/cgroup ro - cgroup2 cgroup rw\n";
  const fs::path root = system_with("container", "0::/docker/abc/inner\n", part);
  put(root / "sys/fs/cgroup/inner/cpu.max", "200000 100000\n");
  CHECK(processor_quota(root) == 2);
  write_text(root / "proc/self/cgroup", "0::/docker/abcd\n");  // another one: what is mounted is all that is known
  put(root / "sys/fs/cgroup/cpu.max", "500000 100000\n");
  CHECK(processor_quota(root) == 5);
  write_text(root / "proc/self/cgroup", "0::/../../other\n");
  CHECK(processor_quota(root) == 5);
  const fs::path whole = system_with("unseen", "0::/docker/abc\n", version_2);
  put(whole / "sys/fs/cgroup/cpu.max", "100000 100000\n");
  CHECK(processor_quota(whole) == 1);
}

TEST_CASE("processors: files that say nothing usable are no quota, and places with odd names are found") {
  const fs::path root = system_with(
      "odd", "rubbish\n::\n0::\n0::/a\n",
      "garbage\n" + std::string(version_2) + R"(35 22 0:34 / /mnt/my\040groups rw - cgroup cgroup rw,cpu)" + "\n");
  for (const char* text : {"", "max", "0 100000", "-5 100000", "x", "100000 0", "99999999999999999999999 1"}) {
    CAPTURE(text);
    put(root / "sys/fs/cgroup/a/cpu.max", text);
    CHECK_FALSE(processor_quota(root));
  }
  put(root / "sys/fs/cgroup/a/cpu.max", "300000");  // the usual period, 100 ms
  CHECK(processor_quota(root) == 3);
  write_text(root / "proc/self/cgroup", "2:cpu:/b\n");
  put(root / "mnt/my groups/b/cpu.cfs_quota_us", "700000");
  CHECK(processor_quota(root) == 7);
  CHECK_FALSE(processor_quota(root / "nowhere"));
}

TEST_CASE("processors: a quota below the processors that the process is bound to decides, and says so") {
  const fs::path root = system_with("decides", "0::/\n", version_2);
  put(root / "sys/fs/cgroup/cpu.max", "20000 100000\n");
  const ThreadCount bound = thread_count(0, root / "nowhere"), limited = thread_count(0, root);
  CHECK(limited.count == 1);
  if (bound.count > 1) CHECK(limited.from == "quota");
  CHECK(thread_count(7, root).count == 7);
  CHECK(thread_count(7, root).from == "option");
  put(root / "sys/fs/cgroup/cpu.max", "1000000000 100000\n");
  CHECK(thread_count(0, root).count == bound.count);
  CHECK(thread_count(0, root).from == bound.from);
}

TEST_CASE("processors: a thread that is bound to one processor gets one thread, in crews too") {
  if (std::thread::hardware_concurrency() < 2) return;  // nothing to be bound within
  cpu_set_t before, one;
  REQUIRE(sched_getaffinity(0, sizeof before, &before) == 0);
  int first = 0;
  while (!CPU_ISSET(first, &before)) ++first;
  CPU_ZERO(&one);
  CPU_SET(first, &one);
  REQUIRE(sched_setaffinity(0, sizeof one, &one) == 0);
  const ThreadCount bound = thread_count();
  const int thread_pool = ThreadPool(0).size();
  REQUIRE(sched_setaffinity(0, sizeof before, &before) == 0);
  CHECK(bound.count == 1);
  CHECK(bound.from == "affinity");
  CHECK(thread_pool == 1);
}

}  // namespace tyndall::test::processors_test
