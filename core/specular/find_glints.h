#pragma once
#include "core/trace/glints.h"
#include "core/trace/scene_view.h"

#include <vector>

namespace tyndall {

/// The glints of the lamps that chains look for, as the camera sees them while nothing is in the way; sorted by row.
/// Only of lamps and balls that rest, for a camera without a lens, and only where one fills less than half of a pixel
/// or glass sends little light its way.
std::vector<Glint> find_glints(const SceneView& scene);

}  // namespace tyndall
