#include "app/files/user_folders.h"

#include <cstdlib>

namespace tyndall {

std::filesystem::path user_folder(const char* xdg_variable, const char* below) {
  const auto folder = [](const char* variable) {
    const char* value = std::getenv(variable);
    const std::filesystem::path path = value ? value : "";
    return path.is_absolute() ? path : std::filesystem::path();
  };
  const std::filesystem::path named = folder(xdg_variable), home = folder("HOME");
  return named.empty() && !home.empty() ? home / below : named;
}

}  // namespace tyndall
