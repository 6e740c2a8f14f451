#include "app/window/system/preferences.h"

#include "app/files/outputs.h"
#include "app/text/numbers.h"
#include "core/system/files.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <fstream>

namespace tyndall {
namespace {

/// Takes what one line says. Returns whether it says anything that a window can have.
bool take(const std::string& name, const std::string& value, Preferences& preferences) {
  if (name == "clean") preferences.clean = value == "on";
  if (name == "clean") return value == "on" || value == "off";
  if (name == "theme") preferences.theme = value == "light" ? Theme::light : Theme::dark;
  if (name == "theme") return value == "light" || value == "dark";
  if (name == "folded") return preferences.folded.insert(value).second;
  if (name != "text-size" && name != "column") {
    preferences.others += name + " " + value + "\n";
    return !name.empty() && name.find_first_not_of("abcdefghijklmnopqrstuvwxyz-") == std::string::npos;
  }
  double number = 0;
  if (!parse_number(value, "", number)) return false;
  if (name == "text-size") preferences.text_size = number;
  if (name == "text-size") return std::find(text_sizes.begin(), text_sizes.end(), number) != text_sizes.end();
  preferences.column = number;
  return number >= narrowest_column && number <= widest_column;
}

}  // namespace

std::filesystem::path preferences_file() {
  const std::filesystem::path config = user_folder("XDG_CONFIG_HOME", ".config");
  return config.empty() ? config : config / "tyndall" / "window.txt";
}

std::optional<Preferences> read_preferences(const std::filesystem::path& file) {
  Preferences preferences;
  std::size_t bytes = 0;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    const std::size_t space = line.find(' ');
    if (space == std::string::npos || !take(line.substr(0, space), line.substr(space + 1), preferences)) return {};
    bytes += line.size() + 1;
  }
  if (bytes > 0 && preferences.others.size() == bytes) return {};
  return preferences;
}

void write_preferences(const std::filesystem::path& file, const Preferences& preferences) {
  if (file.empty()) return;
  std::error_code error;
  std::filesystem::create_directories(file.parent_path(), error);
  std::string text =
      fmt::format("clean {}\ntheme {}\ntext-size {}\ncolumn {}\n", preferences.clean ? "on" : "off",
                  preferences.theme == Theme::light ? "light" : "dark", preferences.text_size, preferences.column);
  for (const std::string& section : preferences.folded) text += "folded " + section + "\n";
  text += preferences.others;
  try {
    write_text_file(file, text);
  } catch (const std::exception&) {
    return;  // the window then starts with its defaults
  }
}

std::filesystem::path set_aside(const std::filesystem::path& file) {
  std::filesystem::path aside = file;
  aside += ".damaged";
  std::error_code error;
  std::filesystem::rename(file, aside, error);
  return error ? std::filesystem::path() : aside;
}

void step_text_size(Preferences& preferences, int steps) {
  double& size = preferences.text_size;
  const auto at = std::lower_bound(text_sizes.begin(), text_sizes.end(), size) - text_sizes.begin();
  size = text_sizes[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(at + steps, 0, text_sizes.size() - 1))];
}

std::filesystem::path user_folder(const char* xdg_variable, const char* below) {
  const auto folder = [](const char* variable) {
    const char* value = std::getenv(variable);
    const std::filesystem::path path = value ? value : "";
    return path.is_absolute() ? path : std::filesystem::path();
  };
  const std::filesystem::path named = folder(xdg_variable);
  return named.empty() ? folder_of_user(below) : named;
}

}  // namespace tyndall
