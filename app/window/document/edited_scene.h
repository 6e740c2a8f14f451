#pragma once
#include "core/scene/slots.h"

#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace tyndall {

/// The scene within one drawing of the window: the document's own until something of it is changed, then a copy, which
/// becomes the document's at the end of the drawing and is the only one that the edit takes.
class EditedScene {
 public:
  explicit EditedScene(std::shared_ptr<const Scene> scene = std::make_shared<const Scene>())
      : shown_(std::move(scene)) {}

  const Scene& operator*() const { return changed_ ? *changed_ : *shown_; }
  const Scene* operator->() const { return &**this; }
  bool is_changed() const { return changed_.has_value(); }

  /// For any change. What was read before, by the operators above, stays as it was.
  Scene& change() {
    pointer_.clear();
    return copy();
  }
  /// Sets a value that the scene has.
  void set(const std::string& pointer, const Value& value) {
    pointer_ = changed_ && pointer != pointer_ ? "" : pointer;
    put_value(copy(), pointer, value);
  }

  /// The pointer of the only value that was set; "": anything may have changed.
  const std::string& pointer() const { return pointer_; }
  /// The changed scene. Here it is as it was shown, then.
  Scene take() {
    Scene taken = std::move(*changed_);
    changed_.reset();
    return taken;
  }

 private:
  Scene& copy() { return changed_ ? *changed_ : changed_.emplace(*shown_); }

  std::shared_ptr<const Scene> shown_;
  std::optional<Scene> changed_;
  std::string pointer_;
};

}  // namespace tyndall
