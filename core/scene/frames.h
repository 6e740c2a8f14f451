#pragma once
#include "core/scene/place.h"
#include "core/scene/scene.h"

/// The frames of a film: scenes in which all values are what the keys of an animation say.
namespace tyndall {

/// The scene at a time of its animation, which is counted in frames; without the animation itself. The shutter counts
/// in frames, too: where it is not [0, 0] a sphere whose center has keys moves during the frame, from its place in this
/// frame at time 0 to that in the next one at time 1. Throws ParseError where a value has no place in the scene, or
/// breaks one of its rules.
Scene scene_at(const Scene& scene, double time);

/// How the frames of a film follow from a scene.
struct FramePlan {
  int frames = 1;
  bool turntable = false;      ///< the camera goes once around look_at, about vup
  bool seed_per_frame = true;  ///< frame n has the scene's seed + n; false: all have the scene's seed
};
/// The scene of one frame, counted from 0. Throws ParseError as above.
Scene frame_scene(const Scene& scene, const FramePlan& plan, int frame);

/// Takes keys away whose value the scene has no longer, such as the fuzz of what has become glass.
void drop_lost_keys(Scene& scene);

/// Throws ParseError unless the scene is valid at every frame that has a key. The error's place is the key.
void check_keys(const Scene& scene);

}  // namespace tyndall
