#include "core/system/mounts.h"

#include <sys/stat.h>
#include <fcntl.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <sstream>
#include <system_error>

namespace tyndall {
namespace {

namespace fs = std::filesystem;

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

std::optional<Mount> mount_of(const std::string& line) {
  Mount mount;
  std::istringstream words(line);
  std::string word;
  words >> word >> word >> word >> mount.root >> mount.point;
  while (words >> word && word != "-") continue;  // optional fields
  words >> mount.type >> word >> mount.options;
  mount.root = unescaped(mount.root), mount.point = unescaped(mount.point);
  return mount.options.empty() || !mount.point.starts_with('/') ? std::nullopt : std::optional(mount);
}

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

std::vector<Mount> mounts(const fs::path& root) {
  std::vector<Mount> found;
  std::ifstream in(root / "proc/self/mountinfo");
  for (std::string line; std::getline(in, line);)
    if (const auto mount = mount_of(line)) found.push_back(*mount);
  return found;
}

bool is_mount_point(const fs::path& file) {
#ifdef STATX_ATTR_MOUNT_ROOT
  struct statx status {};
  const bool known = statx(AT_FDCWD, file.c_str(), 0, 0, &status) == 0;
  if (known && (status.stx_attributes_mask & STATX_ATTR_MOUNT_ROOT) != 0)
    return (status.stx_attributes & STATX_ATTR_MOUNT_ROOT) != 0;
#endif
  std::error_code error;  // an older system, which does not say it of a file
  const fs::path place = fs::canonical(file, error);
  const std::vector<Mount> all = error ? std::vector<Mount>() : mounts();
  return std::any_of(all.begin(), all.end(), [&](const Mount& mount) { return mount.point == place; });
}

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
