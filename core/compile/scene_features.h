#pragma once
#include "core/compile/flatten.h"
#include "core/compile/render_scene.h"

/// Finds the models that a scene contains.
namespace tyndall {

/// Returns the features of a scene. flat: the scene, flattened. Materials and textures count only where something in
/// the picture uses them.
SceneFeatures features_of(const Scene& scene, const Flattened& flat);

}  // namespace tyndall
