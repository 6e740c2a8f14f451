#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>

/// What this process may use: threads, memory, and what is mounted where. Containers and batch systems limit a group of
/// processes by control groups (cgroups): those of version 2, and of version 1. root: the folder whose proc/self says
/// what is mounted and which groups the process belongs to; tests have one of their own.
namespace tyndall {

/// A number of threads, and what decides it.
struct ThreadCount {
  int count = 1;
  /// "option": the user asked for it; "machine": all processors; "affinity": the processors that the process is bound
  /// to (taskset, Slurm, docker --cpuset-cpus); "quota": the processor time that its control group has (docker --cpus).
  std::string from = "option";
};

/// How many threads this process may run at the same time; the one place where that is found out. requested > 0: that
/// many. Else one for each processor that the process may use: those of its affinity, but no more than its quota,
/// rounded up, and at least 1.
ThreadCount thread_count(int requested = 0, const std::filesystem::path& root = "/");

/// How many processors the quotas of the process's control groups come to, rounded up, at least 1: the least of cpu.max
/// (version 2) and of cpu.cfs_quota_us over cpu.cfs_period_us (version 1), from its own group up. For example 2 for a
/// quota of 1.5 processors. Absent: there is no quota.
std::optional<int> processor_quota(const std::filesystem::path& root = "/");

/// The soft limit of something; no_limit: there is none.
enum class Limit { address_space, data, threads };
inline constexpr std::uint64_t no_limit = std::numeric_limits<std::uint64_t>::max();
std::uint64_t limit_of(Limit limit);

/// Memory that is free on this machine, bytes; no_limit: the system does not say.
std::uint64_t memory_of_machine();
/// The most memory that the process has had at a time, bytes.
std::size_t peak_memory();

/// Memory that this process could still take, bytes, and what limits it, such as "left by ulimit -v".
struct FreeMemory {
  std::uint64_t bytes = 0;
  std::string limit;
};
FreeMemory free_memory(const std::filesystem::path& root = "/");

/// Whether something is mounted at the file, so that it cannot be replaced by another one.
bool is_mount_point(const std::filesystem::path& file);

/// The number in the first line of a file of the system that begins with `key`, times the unit, 1024 where it is in kB;
/// no_limit: there is none.
std::uint64_t system_number(const std::filesystem::path& file, const std::string& key, std::uint64_t unit = 1);

}  // namespace tyndall
