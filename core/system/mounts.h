#pragma once
#include <filesystem>
#include <string>
#include <vector>

/// What is mounted where.
namespace tyndall {

/// A line of /proc/self/mountinfo, see proc(5).
struct Mount {
  std::string root;   ///< the part of the file system that is mounted: "/", or below it for a bind mount
  std::string point;  ///< where, absolute
  std::string type;   ///< of the file system, such as "cgroup2"
  std::string options;
};

/// All mounts that this process sees, in the order in which they were made. root: the folder whose proc/self says so;
/// tests have one of their own. Empty where the system does not say.
std::vector<Mount> mounts(const std::filesystem::path& root = "/");

/// Whether something is mounted at the file, so that it cannot be replaced by another one.
bool is_mount_point(const std::filesystem::path& file);

}  // namespace tyndall
