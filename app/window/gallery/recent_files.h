#pragma once
#include <filesystem>
#include <vector>

/// The files that were opened last, which a small file keeps from one start to the next.
namespace tyndall {

inline constexpr std::size_t max_recent_files = 8;

/// $XDG_STATE_HOME/tyndall/recent.txt, else ~/.local/state/tyndall/recent.txt; empty where neither variable is an
/// absolute path.
std::filesystem::path recent_files_list();

/// The files that the list names and that are there, the newest first. Whatever else is in the list is ignored.
std::vector<std::filesystem::path> read_recent_files(const std::filesystem::path& list);
/// Puts a file first in the list: read anew, as another window may have written it. Fails silently.
void add_recent_file(const std::filesystem::path& list, const std::filesystem::path& file);

}  // namespace tyndall
