#pragma once
#include <filesystem>
#include <string>
#include <vector>

/// This room finds out what the operating system lets the process have. What is mounted where, and control groups
/// (cgroups), which containers and batch systems use to limit a group of processes; they are read where they are
/// mounted.
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

/// The folders of the groups that this process belongs to, from its own up to the topmost one that is mounted here,
/// where each may set a limit of its own. Both versions of control groups are looked at: those of version 2, and those
/// of version 1 that have the controller, for example "cpu" or "memory". A folder need not exist: a container may be
/// told a path that it cannot see. root: the folder whose proc/self says so; tests have one of their own.
std::vector<std::filesystem::path> cgroup_folders(const std::string& controller,
                                                  const std::filesystem::path& root = "/");

}  // namespace tyndall
