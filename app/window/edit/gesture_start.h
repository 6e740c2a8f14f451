#pragma once
#include "app/window/edit/linked_objects.h"

#include <cstdint>

/// The scene as it was when the user began to drag.
namespace tyndall {

/// Keeps the scene at the beginning of a gesture, so that what follows from an edit is worked out from there and not
/// from the drawing before: then nothing adds up.
class GestureStart {
 public:
  /// Lets the companions of what was changed follow. now: the scene before this drawing's edits; next: with them.
  /// gesture: see Gestures.
  void finish_edit(const Scene& now, Scene& next, std::uint64_t gesture) {
    if (next.objects == now.objects) return;
    if (gesture != gesture_ || start_.objects.empty()) start_ = now, gesture_ = gesture;
    move_linked_objects(start_, now, next);
  }

 private:
  Scene start_;
  std::uint64_t gesture_ = 0;
};

}  // namespace tyndall
