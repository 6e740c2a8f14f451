#pragma once
#include "core/compile/render_scene.h"

namespace tyndall {

/// The pairs of a medium and a light near it for which sampling distances by angle pays (measured: 1.5 to 16 times less
/// time to the same error; without these conditions up to 2 times more). The medium scatters and is at most 4 mean free
/// paths to its centre; the light sits in it or within half of its size, and reaches a tenth of the way to its edge or
/// to the camera.
NearLamps find_near_lamps(const RenderScene& scene);

}  // namespace tyndall
