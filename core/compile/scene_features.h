#pragma once
#include "core/compile/flatten.h"
#include "core/compile/render_scene.h"

/// Which models a scene needs: what its shapes, media, textures and camera are made of.
namespace tyndall {

/// flat: the scene, flattened. Materials and textures count only where something in the picture uses them.
SceneFeatures features_of(const Scene& scene, const Flattened& flat);

}  // namespace tyndall
