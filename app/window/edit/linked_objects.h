#pragma once
#include "app/window/tools/selection.h"

#include <cstdint>
#include <memory>
#include <vector>

/// Objects that belong to a sphere or box: the fog within it, and the inner spheres of a shell of glass.
namespace tyndall {

/// Whether the medium's boundary has the very numbers of the solid's shape.
bool fills(const Volume& volume, const Solid3d& solid);

/// The objects that go along with the one at that path: media whose boundary equals its shape exactly; and, of a sphere
/// of glass, the smaller spheres around the same centre. All have its placement.
std::vector<ObjectPath> linked_objects(const Scene& scene, const ObjectPath& path);

/// Lets companions follow what was changed between `last` and `next`; all three scenes have the same objects. start:
/// the scene when the user began to drag, from which it is worked out so that nothing adds up. Fog gets the very
/// numbers of its sphere; inner spheres get its centre, and a radius in the same proportion as at the start.
void move_linked_objects(const Scene& start, const Scene& last, Scene& next);

/// Keeps the scene at the beginning of a gesture, so that what follows from an edit is worked out from there and not
/// from the drawing before: then nothing adds up.
class GestureStart {
 public:
  /// Lets the companions of what was changed follow. now: the scene before this drawing's edits; next: with them.
  /// gesture: see Gestures.
  void finish_edit(const std::shared_ptr<const Scene>& now, Scene& next, std::uint64_t gesture) {
    if (gesture != gesture_ || !start_) start_ = now, gesture_ = gesture;
    move_linked_objects(*start_, *now, next);
  }

 private:
  std::shared_ptr<const Scene> start_;
  std::uint64_t gesture_ = 0;
};

}  // namespace tyndall
