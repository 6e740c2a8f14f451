#pragma once
#include "core/guide/ordered_events.h"
#include "core/trace/scene_view.h"

#include <cstdint>
#include <vector>

/// The near-specular elements of a scene.
namespace tyndall {

/// An entry of a column of the scene, in double.
inline double at(const float* column, int i) { return static_cast<double>(column[i]); }

inline constexpr int max_guide_lights = 16;  ///< that light paths start from: the first ones

/// A near-specular element: a sphere, a quad or a face of a box.
struct Thing {
  std::int32_t element = 0;
  bool is_sphere = false;
  Vec3d center, motion;  ///< of a sphere: at time 0, and from there to time 1
  double radius = 0;
  Vec3d corner, u, v;  ///< of a flat
  double fuzz = 0;     ///< 0 for mirrors and glass
  int object = -1;     ///< the specular object whose paths are solved for exactly; -1: none
  double power = 0;    ///< roughly the power that lights send to it
};

/// The things that matter most, at most max_guided_things. Empty if there are none, or no light or diffuse surface.
std::vector<Thing> list_things(const SceneView& scene);

}  // namespace tyndall
