#pragma once
#include "app/window/gallery/thumbnails.h"
#include "app/window/picture/display.h"

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

/// What the list of scenes shows beside names: pictures, and the files that were opened last, which a small file keeps
/// from one start to the next.
namespace tyndall {

inline constexpr std::size_t max_recent_files = 8;

/// The files that the list names and that are there, the newest first. Whatever else is in the list is ignored.
std::vector<std::filesystem::path> read_recent_files(const std::filesystem::path& list);
/// Puts a file first in the list: read anew, as another window may have written it. What has no absolute path is no
/// file, but a built-in scene. Fails silently.
void add_recent_file(const std::filesystem::path& list, const std::filesystem::path& file);

/// By what load_scene takes; null: the scene has no picture.
using SmallPictures = std::map<std::string, std::unique_ptr<const PictureTexture>>;

/// Keeps the pictures as textures, and the list of recent files. Lives within the window's OpenGL context; for the main
/// thread.
class Gallery {
 public:
  /// wake: collect() has something to do; called from any thread.
  explicit Gallery(const std::function<void()>& wake);

  const SmallPictures& pictures() const { return pictures_; }
  /// The newest first.
  const std::vector<std::filesystem::path>& recent() const { return recent_; }

  /// Takes what the background has made. Whether anything is new.
  bool collect();
  /// A scene was opened or saved: its file goes to the head of the recent ones, and its picture is made anew.
  void note_file(const std::filesystem::path& file);

  Thumbnails thumbnails;

 private:
  std::filesystem::path list_;
  std::vector<std::filesystem::path> recent_;
  SmallPictures pictures_;
};

}  // namespace tyndall
