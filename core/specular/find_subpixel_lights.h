#pragma once
#include "core/trace/scene_view.h"
#include "core/trace/subpixel_lights.h"

#include <vector>

namespace tyndall {

/// The subpixel lights of the lights that specular paths look for, as the camera sees them while nothing is in the way;
/// sorted by row. Only of lights and spheres that rest, for a camera without a lens, and only where one fills less than
/// half of a pixel or glass sends little light its way.
std::vector<SubpixelLight> find_subpixel_lights(const SceneView& scene);

}  // namespace tyndall
