#pragma once
#include <filesystem>

/// The folders in which the program keeps things for its user.
namespace tyndall {

/// What an XDG variable such as "XDG_STATE_HOME" names, else $HOME/below, for example ".local/state". Relative paths
/// are no names of folders (XDG Base Directory Specification) and count as not set. Empty: neither variable is set.
std::filesystem::path user_folder(const char* xdg_variable, const char* below);

}  // namespace tyndall
