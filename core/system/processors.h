#pragma once
#include <filesystem>
#include <optional>
#include <string>

/// How many threads this process may run at the same time. The one place where that is found out.
namespace tyndall {

/// A number of threads, and what decides it.
struct ThreadCount {
  int count = 1;
  /// "option": the user asked for it; "machine": all processors; "affinity": the processors that the process is bound
  /// to (taskset, Slurm, docker --cpuset-cpus); "quota": the processor time that its control group has (docker --cpus).
  std::string from = "option";
};

/// requested > 0: that many. Else one for each processor that the process may use: those of its affinity, but no more
/// than its quota, rounded up, and at least 1. root: see cgroup_folders().
ThreadCount thread_count(int requested = 0, const std::filesystem::path& root = "/");

/// How many processors the quotas of the process's control groups come to, rounded up, at least 1: the least of cpu.max
/// (version 2) and of cpu.cfs_quota_us over cpu.cfs_period_us (version 1), from its own group up. For example 2 for a
/// quota of 1.5 processors. Absent: there is no quota.
std::optional<int> processor_quota(const std::filesystem::path& root = "/");

}  // namespace tyndall
