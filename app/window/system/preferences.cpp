#include "app/window/system/preferences.h"

#include "app/files/outputs.h"

#include <cstdlib>
#include <exception>
#include <fstream>
#include <string>

namespace tyndall {

std::filesystem::path preferences_file() {
  const auto folder = [](const char* variable) {
    const char* value = std::getenv(variable);
    return std::filesystem::path(value ? value : "");
  };
  std::filesystem::path config = folder("XDG_CONFIG_HOME");
  if (config.empty() && !folder("HOME").empty()) config = folder("HOME") / ".config";
  return config.empty() ? config : config / "tyndall" / "window.txt";
}

Preferences read_preferences(const std::filesystem::path& file) {
  Preferences preferences;
  std::ifstream in(file);
  for (std::string name, value; in >> name >> value;)
    if (name == "clean" && (value == "on" || value == "off")) preferences.clean = value == "on";
  return preferences;
}

void write_preferences(const std::filesystem::path& file, const Preferences& preferences) {
  if (file.empty()) return;
  std::error_code error;
  std::filesystem::create_directories(file.parent_path(), error);
  try {
    write_text_file(file, std::string("clean ") + (preferences.clean ? "on" : "off") + "\n");
  } catch (const std::exception&) {
    return;  // the window then starts with its defaults
  }
}

}  // namespace tyndall
