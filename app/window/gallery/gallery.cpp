#include "app/window/gallery/gallery.h"

#include "app/files/outputs.h"
#include "app/window/document/autosave.h"

#include <algorithm>
#include <exception>
#include <fstream>

namespace tyndall {
namespace {

namespace fs = std::filesystem;

/// $XDG_STATE_HOME/tyndall/recent.txt, else ~/.local/state/tyndall/recent.txt; empty where neither variable is an
/// absolute path.
fs::path recent_files_list() {
  const fs::path folder = state_folder();
  return folder.empty() ? folder : folder / "recent.txt";
}

}  // namespace

std::vector<fs::path> read_recent_files(const fs::path& list) {
  std::vector<fs::path> files;
  std::ifstream in(list);
  std::error_code ignored;
  for (std::string line; files.size() < max_recent_files && std::getline(in, line);) {
    const fs::path file(line);
    const bool known = std::find(files.begin(), files.end(), file) != files.end();
    if (!known && file.is_absolute() && fs::is_regular_file(file, ignored)) files.push_back(file);
  }
  return files;
}

void add_recent_file(const fs::path& list, const fs::path& file) {
  if (list.empty() || !file.is_absolute() || file.string().find('\n') != std::string::npos) return;
  std::error_code ignored;
  std::vector<fs::path> files = read_recent_files(list);
  std::erase(files, file);
  files.insert(files.begin(), file);
  files.resize(std::min(files.size(), max_recent_files));
  std::string text;
  for (const fs::path& one : files) text += one.string() + "\n";
  fs::create_directories(list.parent_path(), ignored);
  try {
    write_text_file(list, text);
  } catch (const std::exception&) {
    return;  // the list then stays as it is
  }
}

Gallery::Gallery(const std::function<void()>& wake)
    : thumbnails(thumbnails_folder(), wake), list_(recent_files_list()), recent_(read_recent_files(list_)) {}

bool Gallery::collect() {
  return thumbnails.collect([this](const std::string& scene, const ScreenPicture& picture) {
    const bool any = !picture.rgb.empty();
    pictures_[scene] =
        any ? std::make_unique<const PictureTexture>(picture.width, picture.height, picture.rgb) : nullptr;
  });
}

void Gallery::note_file(const std::filesystem::path& file) {
  add_recent_file(list_, file);
  recent_ = read_recent_files(list_);
  if (!recent_.empty()) thumbnails.forget(recent_.front().string());
}

}  // namespace tyndall
