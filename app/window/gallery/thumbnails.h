#pragma once
#include "app/window/document/job_queue.h"
#include "app/window/gallery/thumbnail.h"

#include <atomic>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

/// The small pictures of scenes, made in the background.
namespace tyndall {

/// Finds pictures in the cache folder, and renders those that are not there, one at a time and at low priority. For
/// the main thread.
class Thumbnails {
 public:
  /// folder: of the cache; empty: nothing is kept. wake: collect() has something to do; called from any thread.
  Thumbnails(std::filesystem::path folder, const std::function<void()>& wake)
      : folder_(std::move(folder)), jobs_(wake) {}
  ~Thumbnails() { closing_ = true; }
  Thumbnails(const Thumbnails&) = delete;
  Thumbnails& operator=(const Thumbnails&) = delete;

  /// The scenes whose pictures are to be seen now, by what load_scene takes: the first that has none is made next.
  /// Takes the place of what was wanted before.
  void want(std::vector<std::string> scenes);
  /// Calls `take` for each picture that has come; an empty one where a scene has none, because it cannot be read.
  /// Whether there were any.
  bool collect(const std::function<void(const std::string& scene, const Thumbnail& picture)>& take);
  /// The scene's file has changed: its picture is made again when it is wanted.
  void forget(const std::string& scene) { known_.erase(scene); }
  /// Whether nothing is being made.
  bool idle() const { return jobs_.idle(); }

 private:
  void begin_next();

  std::filesystem::path folder_;
  std::vector<std::string> wanted_;
  std::set<std::string> known_;  ///< made, or being made
  std::map<std::string, Thumbnail> came_;
  std::atomic<bool> closing_ = false;
  JobQueue jobs_;  // last: its jobs use the others
};

}  // namespace tyndall
