#include "app/window/gallery/gallery.h"

namespace tyndall {

Gallery::Gallery(const std::function<void()>& wake)
    : list_(recent_files_list()), recent_(read_recent_files(list_)), thumbnails_(thumbnails_folder(), wake) {}

bool Gallery::collect() {
  return thumbnails_.collect([this](const std::string& scene, const Thumbnail& picture) {
    const bool any = !picture.rgb.empty();
    pictures_[scene] =
        any ? std::make_unique<const PictureTexture>(picture.width, picture.height, picture.rgb) : nullptr;
  });
}

void Gallery::note_file(const std::filesystem::path& file) {
  if (file.empty()) return;
  add_recent_file(list_, file);
  recent_ = read_recent_files(list_);
  if (!recent_.empty()) thumbnails_.forget(recent_.front().string());
}

}  // namespace tyndall
