#include "app/comparison/picture_folder.h"

#include "core/base/error.h"
#include "core/base/text.h"

#include <algorithm>

namespace tyndall {
namespace {

namespace fs = std::filesystem;

bool is_picture(const fs::path& file) {
  const std::string ending = lower_case(file.extension().string());
  const std::string endings = picture_endings + std::string(" ");
  return !ending.empty() && endings.find(ending + " ") != endings.npos;
}

class Walk {
 public:
  explicit Walk(const std::vector<fs::path>& without) : without_(without) {}

  /// name: of the folder, as the names of what is in it begin; empty for the outermost.
  void into(const fs::path& folder, const std::string& name) {
    around_.push_back(folder);
    std::error_code error;
    fs::directory_iterator entry(folder, error);
    for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
      take(*entry, (fs::path(name) / entry->path().filename()).generic_string());
    }
    if (error) throw IoError(folder.string() + ": cannot read the folder: " + error.message());
    around_.pop_back();
  }

  PictureFolder found;

 private:
  void take(const fs::directory_entry& entry, const std::string& name) {
    std::error_code ignored;  // what cannot be looked at is no folder, and as a picture it fails
    const fs::path& path = entry.path();
    const auto is_this = [&](const fs::path& other) { return fs::equivalent(path, other, ignored); };
    if (!entry.is_directory(ignored)) {
      if (is_picture(path))
        found.pictures.emplace(name, path);
      else if (path.filename().string().front() != '.')
        found.others.push_back(name);
    } else if (std::any_of(around_.begin(), around_.end(), is_this)) {
      found.loops.push_back(name);
    } else if (std::none_of(without_.begin(), without_.end(), is_this)) {
      into(path, name);
    }
  }

  const std::vector<fs::path>& without_;
  std::vector<fs::path> around_;  ///< the folders that are being gone through, the outermost first
};

}  // namespace

PictureFolder pictures_in(const fs::path& folder, const std::vector<fs::path>& without) {
  Walk walk(without);
  walk.into(folder, "");
  std::sort(walk.found.others.begin(), walk.found.others.end());
  std::sort(walk.found.loops.begin(), walk.found.loops.end());
  return std::move(walk.found);
}

}  // namespace tyndall
