#pragma once
#include "core/compile/flatten.h"
#include "core/compile/render_scene.h"

#include <cstdint>
#include <vector>

/// Which surface the camera stands on.
namespace tyndall {

/// The surface that the centre of the camera's lens lies on, up to the rounding of single precision: 2^-21 of the
/// largest coordinate or radius in play. Of several the nearest, of equally near ones the first. Spheres count only if
/// they rest while the shutter is open; quads and faces of boxes only if no edge cuts through the lens.
/// Whoever is so near a surface, but not on it, still sees it: the place of a floor may be exact in single precision
/// although its corners are far away. Only what is nearer to a sphere than half of the spacing of floats counts as
/// touching it.
/// first_element: the first element of each shape. origin: the world position of the compiled scene's (0, 0, 0).
CameraSurface camera_surface(const Flattened& flat, const std::vector<std::int32_t>& first_element,
                             const Camera& camera, Vec3d origin);

}  // namespace tyndall
