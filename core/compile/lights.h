#pragma once
#include "core/compile/flatten.h"
#include "core/compile/render_scene.h"

namespace tyndall {

/// Collects the emitting primitives of a scene. first_element: of each shape. Lights without power are left out: they
/// are ordinary, black surfaces. Fills elements.light too.
Lights collect_lights(const Scene& scene, const Flattened& flat, const std::vector<std::int32_t>& first_element,
                      Vec3d origin, Elements& elements);

}  // namespace tyndall
