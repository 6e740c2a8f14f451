#include "core/system/processors.h"

#ifdef __linux__
#include <sched.h>
#endif

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <system_error>
#include <thread>
#include <vector>

namespace tyndall {
namespace {

namespace fs = std::filesystem;

int processors_of_machine() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

/// The processors that the calling thread is bound to.
int processors_of_affinity() {
#ifdef __linux__
  cpu_set_t set[64];  // room for 65,536, eight times as many as Linux can have
  if (sched_getaffinity(0, sizeof set, set) == 0) return std::max(1, CPU_COUNT_S(sizeof set, set));
#endif
  return processors_of_machine();
}

/// The quota that one group sets. Files that are not there, and "max", leave the numbers as they are.
std::optional<int> quota_of(const fs::path& folder) {
  std::int64_t time = 0, period = 100'000;
  std::ifstream file(folder / "cpu.max");
  if (file >> time) {
    file >> period;
  } else {
    time = 0;
    std::ifstream(folder / "cpu.cfs_quota_us") >> time;
    std::ifstream(folder / "cpu.cfs_period_us") >> period;
  }
  if (time <= 0 || period <= 0) return std::nullopt;  // -1: none
  const std::int64_t rounded_up = time / period + (time % period > 0);
  return static_cast<int>(std::clamp<std::int64_t>(rounded_up, 1, 1 << 20));
}

/// A line of /proc/self/mountinfo, see proc(5).
struct Mount {
  std::string root;   ///< the part of the file system that is mounted: "/", or below it for a bind mount
  std::string point;  ///< where, absolute
  std::string type;   ///< of the file system, such as "cgroup2"
  std::string options;
};

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

bool names(const std::string& list, const std::string& word) {
  return ("," + list + ",").find("," + word + ",") != std::string::npos;
}

/// All mounts that this process sees, in the order in which they were made.
std::vector<Mount> mounts(const fs::path& root) {
  std::vector<Mount> found;
  std::ifstream in(root / "proc/self/mountinfo");
  for (std::string line, word; std::getline(in, line);) {
    Mount mount;
    std::istringstream words(line);
    words >> word >> word >> word >> mount.root >> mount.point;
    while (words >> word && word != "-") continue;  // optional fields
    words >> mount.type >> word >> mount.options;
    mount.root = unescaped(mount.root), mount.point = unescaped(mount.point);
    if (!mount.options.empty() && mount.point.starts_with('/')) found.push_back(mount);
  }
  return found;
}

/// The folders of the groups that this process belongs to, from its own up to the topmost one that is mounted here,
/// where each may set a limit of its own: those of version 2, and those of version 1 that have the controller, for
/// example "cpu" or "memory". A folder need not exist: a container may be told a path that it cannot see.
std::vector<fs::path> cgroup_folders(const std::string& controller, const fs::path& root) {
  std::vector<fs::path> folders;
  for (const Mount& mount : mounts(root)) {
    const bool version_1 = mount.type == "cgroup" && names(mount.options, controller);
    if (!version_1 && mount.type != "cgroup2") continue;
    const fs::path top = root / mount.point.substr(1);
    std::ifstream groups(root / "proc/self/cgroup");
    for (std::string line; std::getline(groups, line);) {  // "3:cpu,cpuacct:/a/b"; "0::/a/b" for version 2
      const std::size_t first = line.find(':'), second = line.find(":/", first + 1);
      if (second == line.npos) continue;
      const std::string controllers = line.substr(first + 1, second - first - 1);
      if (version_1 ? !names(controllers, controller) : !controllers.empty()) continue;
      fs::path below = fs::path(line.substr(second + 1)).lexically_relative(mount.root);
      // Else the group is the mounted one itself, or cannot be seen here.
      const bool is_below = !below.empty() && below != "." && *below.begin() != "..";
      for (; is_below && !below.empty(); below = below.parent_path()) folders.push_back(top / below);
      folders.push_back(top);
    }
  }
  return folders;
}

std::uint64_t less(std::uint64_t limit, std::uint64_t used) {
  return limit == no_limit ? no_limit : limit - std::min(limit, used);
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

std::uint64_t system_number(const fs::path& file, const std::string& key, std::uint64_t unit) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with(key)) continue;
    const std::size_t digits = line.find_first_of("0123456789", key.size());
    return digits == line.npos ? no_limit : unit * std::strtoull(line.c_str() + digits, nullptr, 10);
  }
  return no_limit;
}

FreeMemory free_memory(const fs::path& root) {
  FreeMemory free{memory_of_machine(), "free on this machine"};
  const auto at_most = [&free](std::uint64_t bytes, const char* limit) {
    if (bytes < free.bytes) free = {bytes, limit};
  };
  for (const fs::path& group : cgroup_folders("memory", root)) {
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

bool is_mount_point(const fs::path& file) {
  std::error_code error;
  const fs::path place = fs::canonical(file, error);
  const std::vector<Mount> all = error ? std::vector<Mount>() : mounts("/");
  return std::any_of(all.begin(), all.end(), [&](const Mount& mount) { return mount.point == place; });
}

}  // namespace tyndall
