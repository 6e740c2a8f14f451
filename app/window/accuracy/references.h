#pragma once
#include "app/window/accuracy/live_accuracy.h"
#include "app/window/document/editor.h"

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <utility>

/// How references come into the window: from files, and from the screen.
namespace tyndall {

/// Loads the reference that the user chooses, and tells the user which one is in use.
class References {
 public:
  /// shown: the document as it is on the screen, where its picture may have another size than its file says. wake:
  /// called from any thread when collect() has something to do.
  References(Editor& editor, std::function<Document()> shown, LiveAccuracy& accuracy, MessageLine& messages,
             const std::function<void()>& wake)
      : editor_(editor),
        shown_(std::move(shown)),
        accuracy_(accuracy),
        messages_(messages),
        wake_(wake),
        rendering_(wake) {}
  ~References() { stop(); }

  /// Reads an image of the document, in the background.
  void open(const std::filesystem::path& file);
  /// Takes a file that was dropped on the window, in the background: an image without a scene in it becomes the
  /// reference, all else is opened as a scene. About one that may be a sky the user has to be asked.
  void open_dropped(const std::filesystem::path& file);
  /// The picture that may be a sky or a reference; empty: there is none. Asked for once.
  std::filesystem::path take_doubtful() { return std::exchange(doubtful_, {}); }
  void set(std::shared_ptr<const Reference> reference);
  void drop();
  /// Renders one in the background, instead of one that is being rendered. Errors are true when it is there, not
  /// before.
  void render(const ReferenceOrder& order);
  /// Whether one is being rendered.
  bool busy() const { return !rendering_.idle(); }
  /// Takes what was rendered, tells how far it is, and stops if the scene is another one now. Whether anything came.
  bool collect();

 private:
  void stop() { ++order_; }
  JobQueue::Result read(const std::filesystem::path& file, const Document& document);

  Editor& editor_;
  std::function<Document()> shown_;
  LiveAccuracy& accuracy_;
  MessageLine& messages_;
  std::function<void()> wake_;
  std::atomic<std::uint64_t> order_ = 0;  ///< counts up; what is rendered for an older number stops
  /// Samples a pixel so far. Each order has its own: an older one still counts until it sees that it is one.
  std::shared_ptr<std::atomic<std::uint32_t>> rendered_;
  std::uint32_t told_ = 0;  ///< of these, in the newest message
  std::filesystem::path doubtful_;
  ReferenceOrder newest_;
  std::string doing_;   ///< "rendering a reference with another seed"
  JobQueue rendering_;  // declared last, because it uses the others
};

}  // namespace tyndall
