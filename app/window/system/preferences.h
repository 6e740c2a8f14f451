#pragma once
#include <filesystem>

/// Settings of the window that a small file keeps from one start to the next.
namespace tyndall {

/// What the window remembers from one start to the next.
struct Preferences {
  bool clean = true;  ///< the clean view is on
  bool operator==(const Preferences&) const = default;
};

/// $XDG_CONFIG_HOME/tyndall/window.txt, else ~/.config/tyndall/window.txt; empty where neither variable is set.
std::filesystem::path preferences_file();

/// What the file says; the defaults for what it does not say, or if it cannot be read.
Preferences read_preferences(const std::filesystem::path& file);
/// Writes the file and the folders above it. Fails silently: the next start then has the old ones.
void write_preferences(const std::filesystem::path& file, const Preferences& preferences);

}  // namespace tyndall
