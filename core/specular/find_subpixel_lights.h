#pragma once
#include "core/trace/scene_view.h"
#include "core/trace/subpixel_lights.h"

#include <vector>

namespace tyndall {

/// Returns the subpixel lights of all lights that have specular paths, as the camera sees them if nothing blocks them,
/// and those in other boxes; sorted by row. A box is kept only where it fills less than half of a pixel or where glass
/// sends little light along its path. Empty for a camera with a lens or with motion blur.
std::vector<SubpixelLight> find_subpixel_lights(const SceneView& scene, const std::vector<PictureBox>& others = {});

}  // namespace tyndall
