#include "core/system/cgroup.h"

#include "core/system/mounts.h"

#include <fstream>
#include <optional>

namespace tyndall {
namespace {

namespace fs = std::filesystem;

bool names(const std::string& list, const std::string& word) {
  return ("," + list + ",").find("," + word + ",") != std::string::npos;
}

/// The group's path as a line of proc/self/cgroup has it ("3:cpu,cpuacct:/a/b"; "0::/a/b" for version 2), if the line
/// is of the hierarchy that is mounted.
std::optional<std::string> group_in(const std::string& line, const Mount& mount, const std::string& controller) {
  const std::size_t first = line.find(':'), second = line.find(":/", first + 1);
  if (first == line.npos || second == line.npos) return std::nullopt;
  const std::string controllers = line.substr(first + 1, second - first - 1);
  const bool fits = mount.type == "cgroup2" ? controllers.empty() : names(controllers, controller);
  return fits ? std::optional(line.substr(second + 1)) : std::nullopt;
}

/// The part of the path that lies below the mounted root; "": the group is the root, or cannot be seen here.
std::string below(const std::string& group, const std::string& root) {
  if (group.find("/..") != std::string::npos) return "";
  if (root == "/") return group.substr(1);
  return group.starts_with(root + "/") ? group.substr(root.size() + 1) : "";
}

}  // namespace

std::vector<fs::path> cgroup_folders(const std::string& controller, const fs::path& root) {
  std::vector<fs::path> folders;
  for (const Mount& mount : mounts(root)) {
    const bool version_1 = mount.type == "cgroup" && names(mount.options, controller);
    if (!version_1 && mount.type != "cgroup2") continue;
    const fs::path top = root / mount.point.substr(1);
    std::ifstream groups(root / "proc/self/cgroup");
    for (std::string line; std::getline(groups, line);) {
      const auto group = group_in(line, mount, controller);
      if (!group) continue;
      for (fs::path rest = below(*group, mount.root); !rest.empty(); rest = rest.parent_path())
        folders.push_back(top / rest);
      folders.push_back(top);
    }
  }
  return folders;
}

}  // namespace tyndall
