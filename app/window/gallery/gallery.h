#pragma once
#include "app/report/contact_sheet.h"
#include "app/window/document/job_queue.h"
#include "app/window/picture/display.h"
#include "core/render/frame.h"
#include "core/scene/load.h"

#include <atomic>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

/// This room makes what the list of scenes shows beside names: small pictures, and the files that were opened last,
/// which it keeps from one start to the next; and the small pictures of cameras that were put aside.
namespace tyndall {

/// 16 hex digits that say which picture a scene has: they change with the text of the scene and the bytes of its
/// textures, and with how thumbnails are made.
std::string thumbnail_key(const LoadedScene& loaded);

/// A picture of the cache. Nothing if it is not there, or is damaged.
std::optional<ScreenPicture> read_thumbnail(const std::filesystem::path& file);
/// Puts a picture into the cache; fails silently, as it can be made again.
void write_thumbnail(const std::filesystem::path& file, const ScreenPicture& picture);

/// Finds pictures in the cache folder, and renders those that are not there, one at a time and at low priority. For
/// the main thread.
class Thumbnails {
 public:
  /// Gets a picture that has come; an empty one where the scene has none, because it cannot be read.
  using Take = std::function<void(const std::string& scene, const ScreenPicture& picture)>;

  /// folder: of the cache; empty: nothing is kept. take: called by collect(). wake: collect() has something to do;
  /// called from any thread.
  Thumbnails(std::filesystem::path folder, Take take, const std::function<void()>& wake)
      : folder_(std::move(folder)), take_(std::move(take)), jobs_(wake) {}
  ~Thumbnails() { closing_ = true; }

  /// The scenes whose pictures are to be seen now, by what load_scene takes: the first that has none is made next.
  /// Takes the place of what was wanted before.
  void want(std::vector<std::string> scenes);
  /// Takes what has come. Whether there was anything.
  bool collect();
  /// The scene's file has changed: its picture is made again when it is wanted.
  void forget(const std::string& scene) { known_.erase(scene); }
  /// Whether nothing is being made.
  bool idle() const { return jobs_.idle(); }

 private:
  void begin_next();

  std::filesystem::path folder_;
  Take take_;
  std::vector<std::string> wanted_;
  std::set<std::string> known_;  ///< made, or being made
  std::atomic<bool> closing_ = false;
  JobQueue jobs_;  // last: its jobs use the others
};

inline constexpr std::size_t max_recent_files = 8;

/// The files that the list names and that are there, the newest first. Whatever else is in the list is ignored.
std::vector<std::filesystem::path> read_recent_files(const std::filesystem::path& list);
/// Puts a file first in the list: read anew, as another window may have written it. What has no absolute path is no
/// file, but a built-in scene. Fails silently.
void add_recent_file(const std::filesystem::path& list, const std::filesystem::path& file);

/// By what load_scene takes; null: the scene has no picture.
using SmallPictures = std::map<std::string, std::shared_ptr<const PictureTexture>>;

/// A camera that the user has put aside, with a small picture. They last as long as the window.
struct CameraSlot {
  Camera camera;
  std::shared_ptr<const PictureTexture> picture;  ///< null: there was none yet
};
using CameraSlots = std::vector<CameraSlot>;

inline constexpr std::size_t max_camera_slots = 8;

/// A frame as a small picture of at most 96 x 60 pixels; empty where the frame has no picture yet.
ScreenPicture small_picture(const Frame& frame, const Display& display);

/// Puts a camera into a new slot; where all are taken, the oldest goes. frame: on the screen, may be null.
void store_camera(CameraSlots& slots, const Camera& camera, const Frame* frame, const Display& display);
/// The slot that follows the one with this camera, the first one for a camera that is in none; nothing without slots.
std::optional<std::size_t> next_slot(const CameraSlots& slots, const Camera& camera);

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
  bool collect() { return thumbnails.collect(); }
  /// A scene was opened or saved: its file goes to the head of the recent ones, and its picture is made anew.
  void note_file(const std::filesystem::path& file);

  Thumbnails thumbnails;

 private:
  std::filesystem::path list_;
  std::vector<std::filesystem::path> recent_;
  SmallPictures pictures_;
};

}  // namespace tyndall
