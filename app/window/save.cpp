#include "app/window/save.h"

#include "core/film/image_io.h"
#include "core/film/image_io_file.h"
#include "core/scene/error.h"
#include "core/scene/json.h"

#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <span>

namespace tyndall {

namespace fs = std::filesystem;

bool has_comments(std::string_view text) {
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (in_string && text[i] == '\\')
      ++i;
    else if (text[i] == '"')
      in_string = !in_string;
    else if (!in_string && text[i] == '/')
      return true;  // nothing else in JSON has a slash
  }
  return false;
}

void save_scene(const Scene& scene, const fs::path& file) {
  try {
    WholeFile out(file);
    const std::string text = write_scene(scene);
    out.write(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
    out.commit();
  } catch (const ImageFileError& error) {
    throw IoError(error.what());
  }
}

std::string stem_of(const std::string& title) {
  std::string stem = fs::path(title).stem().string();
  const std::size_t dash = stem.rfind('-');
  if (dash != std::string::npos && dash > 0 && stem.size() - dash >= 4 &&
      stem.find_first_not_of("0123456789", dash + 1) == std::string::npos)
    stem.resize(dash);
  return stem.empty() ? "scene" : stem;
}

fs::path snapshot_base(const fs::path& folder, const std::string& stem, int least) {
  for (int number = least;; ++number) {
    char text[16];
    std::snprintf(text, sizeof text, "-%03d", number);
    const fs::path base = folder / (stem + text);
    std::error_code ignored;
    const auto taken = [&](const char* ending) {
      return fs::symlink_status(base.string() + ending, ignored).type() != fs::file_type::not_found;
    };
    if (!taken(".png") && !taken(".exr")) return base;
  }
}

int snapshot_number(const fs::path& base) {
  const std::string name = base.filename().string();
  return std::atoi(name.c_str() + name.rfind('-') + 1);
}

}  // namespace tyndall
