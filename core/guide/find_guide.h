#pragma once
#include "core/trace/scene_view.h"

/// Finds the guide of a scene.
namespace tyndall {

/// The least Guide::expected_variance with which a guide is made.
inline constexpr double worthwhile_variance = 2;

/// Makes the guide of a scene: a pure function of its geometry, materials and lights. It has lobes only where it pays.
Guide find_guide(const SceneView& scene);

}  // namespace tyndall
