#pragma once
#include <filesystem>
#include <string>
#include <vector>

/// This room finds out what the operating system lets the process have. Control groups (cgroups): what containers and
/// batch systems use to limit a group of processes.
namespace tyndall {

/// The folders of the groups that this process belongs to, from its own up to the topmost one that is mounted here,
/// where each may set a limit of its own. Both versions of control groups are looked at: those of version 2, and those
/// of version 1 that have the controller, for example "cpu" or "memory". A folder need not exist: a container may be
/// told a path that it cannot see. root: the folder whose proc/self says so; tests have one of their own.
std::vector<std::filesystem::path> cgroup_folders(const std::string& controller,
                                                  const std::filesystem::path& root = "/");

}  // namespace tyndall
