#pragma once
#include "core/base/vec.h"
#include "core/system/child.h"
#include "core/system/connection.h"
#include "core/system/locks.h"

#include <atomic>
#include <filesystem>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace tyndall_book {
using vector = tyndall::Vec3d;
}
#include "app/book/tyndall/book/functions.h"

namespace tyndall {

/// A reader's program that has come to its first ray, and from then on computes samples when it is asked. It runs under
/// guard, until this is destroyed or it ends by itself. Its functions throw IoError where it has ended.
class OwnProgram {
 public:
  /// Starts it. name: what messages call it. go_on: asked now and then; false ends it; may be empty.
  OwnProgram(std::string name, ChildPlan plan, std::function<bool()> go_on);
  ~OwnProgram();
  OwnProgram(const OwnProgram&) = delete;
  OwnProgram& operator=(const OwnProgram&) = delete;

  /// go_on is not asked any more.
  void leave_alone();

  /// What it tells: see message_head in tyndall/book/functions.h.
  struct Message {
    char letter = 0;
    std::string bytes;
  };
  /// The next message; nothing: it has ended, or has said nothing for so long.
  std::optional<Message> next_message(double seconds);

  /// Linear colours of places in the picture. For any number of threads.
  std::vector<Vec3d> samples(const std::vector<tyndall_book::pixel_place>& places);

  /// Whether several samples come within 20 ms; false at first. Those of a slow one should be asked for one by one.
  bool is_quick() const { return batch_ > 1; }

  /// How it ended, or ends now.
  const ChildEnd& end();

 private:
  void ask(const tyndall_book::pixel_place* places, std::size_t count, Vec3d* colours);

  OpenFile channel_;
  std::string name_;
  std::atomic<bool> stops_ = false;
  Mutex wanted_mutex_;
  std::function<bool()> go_on_;
  Mutex mutex_;                         ///< one question at a time
  std::atomic<std::size_t> batch_ = 1;  ///< places of a question, so that it takes about 10 ms
  std::shared_future<ChildEnd> end_;
};

/// What a program shows: a scene, or samples of its own.
struct ProgramScene {
  std::string json;                    ///< a scene file's text, with size, samples and depth; "": there is none
  std::string reason;                  ///< why there is none, in one sentence
  tyndall_book::picture_told picture;  ///< its size, and what it does otherwise than Tyndall
  std::vector<std::string> notes;      ///< what the user should know, a line each
  std::vector<std::vector<tyndall_book::image_value>> images;  ///< values of the scene's textures of images, in order
  std::vector<std::filesystem::path> files;                    ///< of the reader's, that were read
  std::shared_ptr<OwnProgram> own;                             ///< computes what it would
};

}  // namespace tyndall
