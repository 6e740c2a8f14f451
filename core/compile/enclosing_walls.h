#pragma once
#include "core/compile/flatten.h"

#include <cstddef>

/// Finds walls that cannot cast a shadow into the scene.
namespace tyndall {

/// Whether a placed shape is a quad that encloses the scene: all shapes and media stay on one side of its plane while
/// the shutter is open (up to rounding: 1e-7 of the scene's extent). Example: a wall of a closed room. Such a wall
/// never stands between two points of the scene, so shadow rays need not be tested against it.
bool bounds_scene(const Flattened& flat, std::size_t shape, const Camera& camera);

}  // namespace tyndall
