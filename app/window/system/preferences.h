#pragma once
#include "app/window/system/layout.h"
#include "app/window/system/style.h"

#include <array>
#include <filesystem>
#include <optional>
#include <set>
#include <string>

/// Settings of the window that a small file keeps from one start to the next.
namespace tyndall {

/// The sizes that texts, and with them all controls, can have: fractions of the usual one.
inline constexpr std::array<double, 8> text_sizes{0.8, 0.9, 1, 1.1, 1.25, 1.5, 1.75, 2};

/// What the window remembers from one start to the next.
struct Preferences {
  bool clean = true;  ///< the clean view is on
  Theme theme = Theme::dark;
  double text_size = 1;          ///< one of text_sizes
  double column = column_width;  ///< width of the column, in units of the design; see narrowest_column
  std::set<std::string> folded;  ///< names of the sections that are closed
  std::string others{};          ///< lines that another version wrote, which are kept for it
  bool operator==(const Preferences&) const = default;
};

/// $XDG_CONFIG_HOME/tyndall/window.txt, else ~/.config/tyndall/window.txt; empty where neither variable is an absolute
/// path.
std::filesystem::path preferences_file();

/// What the file says; the defaults for what it does not say, and if there is none. Nothing if it is damaged: lines
/// without a name, values that a window cannot have, or nothing that a window knows.
std::optional<Preferences> read_preferences(const std::filesystem::path& file);
/// Writes the file whole or not at all, and the folders above it. Fails silently: the next start then has the old ones.
void write_preferences(const std::filesystem::path& file, const Preferences& preferences);
/// Gives a damaged file another name, so that it is told of once; returns that name, empty if that failed.
std::filesystem::path set_aside(const std::filesystem::path& file);

/// Makes texts so many steps larger, or smaller.
void step_text_size(Preferences& preferences, int steps);

/// What an XDG variable such as "XDG_STATE_HOME" names, else $HOME/below, for example ".local/state". Relative paths
/// are no names of folders (XDG Base Directory Specification) and count as not set. Empty: neither variable is set.
std::filesystem::path user_folder(const char* xdg_variable, const char* below);

}  // namespace tyndall
