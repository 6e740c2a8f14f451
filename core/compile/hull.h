#pragma once
#include "core/compile/flatten.h"

#include <cstddef>

namespace tyndall {

/// Whether a placed shape is a quad that bounds the scene: all shapes and media, over the whole shutter, lie on one
/// side of its plane, but for rounding (1e-7 of the scene's reach). Then it hides nothing that is within the scene from
/// anything else within it, and no shadow ray needs to ask.
bool bounds_scene(const Flattened& flat, std::size_t shape, const Camera& camera);

}  // namespace tyndall
