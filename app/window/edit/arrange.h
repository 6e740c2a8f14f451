#pragma once
#include "app/window/tools/camera_control.h"
#include "app/window/tools/selection.h"
#include "core/base/vec.h"

#include <cstdint>
#include <memory>
#include <vector>

/// This room edits the objects and materials of a scene: a scene goes in, the scene changes, and nothing is drawn.
/// Every function leaves numbers that a person would write. Here: moving, turning and sizing objects; and the
/// objects that belong to a sphere or box, which are the fog within it and the inner spheres of a shell of glass.
namespace tyndall {

/// The transform of an object that moving and turning it changes: its own, or a medium's boundary's where its own has
/// nothing.
Transform& own_transform(Object& object);
const Transform& own_transform(const Object& object);

/// The numbers that moving an object changes: the shift at the end of its transform, else the shape's own place (the
/// centre of a sphere, the corner of a quad, the lower corner of a box). In the frame of the groups around it.
Vec3d anchor_of(const Scene& scene, const ObjectPath& path);
/// Sets these numbers; what else the shape holds goes along.
void set_anchor(Scene& scene, const ObjectPath& path, Vec3d anchor);

/// Where the frame of the groups around an object is in the world.
Placement outer_placement(const Scene& scene, const ObjectPath& path);

/// Turns an object about the vertical through its middle, by degrees in the sense of "rotate_y". A shape without a
/// transform is put around the origin first, so that its transform holds its place and its angle.
void rotate_object(Scene& scene, const ObjectPath& path, double degrees);
/// Its present angle, degrees, without that of the groups around it.
double angle_of(const Scene& scene, const ObjectPath& path);

/// The middle of an object in the world; of an empty group its origin.
Vec3d middle_of(const Scene& scene, const ObjectPath& path);

/// A number of a shape's size, and the place from which it can be pulled.
struct SizeGrip {
  Vec3d at;          ///< in the world
  Vec3d pull;        ///< unit: pulling this way makes the shape larger
  double value = 0;  ///< grows as far as the grip is pulled: a radius, an edge's length, how far out a face of a box is
  const char* name;  ///< "radius", "u", "v", "x", "-x", "y", "-y", "z", "-z"
};

/// The grips of a shape: a sphere's radius, a quad's edges, a box's faces. None for groups. across: unit, where a
/// sphere's grip is seen from its centre.
std::vector<SizeGrip> size_grips(const Scene& scene, const ObjectPath& path, Vec3d across);

/// Sets the number of a grip (its place in the list). What cannot be so small stops at `minimum` > 0.
void set_size(Scene& scene, const ObjectPath& path, std::size_t grip, double value, double minimum);

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
