#pragma once
#include "core/guide/guide.h"

namespace tyndall {

/// Makes the guide of a scene: a pure function of its geometry, materials and lights. It has lobes only where it pays.
Guide find_guide(const SceneView& scene);

}  // namespace tyndall
