#pragma once
#include "app/window/accuracy/live_accuracy.h"
#include "app/window/document/editor.h"

#include <filesystem>
#include <memory>

/// How references come into the window: from files, and from the screen.
namespace tyndall {

/// Loads the reference that the user chooses, and tells the user which one is in use.
class References {
 public:
  References(Editor& editor, LiveAccuracy& accuracy, MessageLine& messages)
      : editor_(editor), accuracy_(accuracy), messages_(messages) {}

  /// Reads an image of the document, in the background.
  void open(const std::filesystem::path& file);
  /// Takes a file that was dropped on the window, in the background: an image without a scene in it becomes the
  /// reference, all else is opened as a scene.
  void open_dropped(const std::filesystem::path& file);
  void set(std::shared_ptr<const Reference> reference);
  void drop() { accuracy_.set_reference(nullptr); }

 private:
  JobQueue::Result read(const std::filesystem::path& file, const Document& document);

  Editor& editor_;
  LiveAccuracy& accuracy_;
  MessageLine& messages_;
};

}  // namespace tyndall
