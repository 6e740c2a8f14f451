#pragma once
#include "core/compile/flatten.h"
#include "core/compile/render_scene.h"

#include <cstddef>
#include <cstdint>
#include <vector>

/// What surrounds the scene and the camera: walls that cannot cast a shadow into the scene, and the surface on which
/// the camera stands.
namespace tyndall {

/// Returns the surface on which the centre of the camera's lens lies, up to the rounding of single precision: 2^-21 of
/// the largest coordinate or radius involved. Of several surfaces the nearest one, of equally near ones the first.
///
/// Spheres count only if they rest while the shutter is open; flat shapes and faces of boxes only if no edge cuts
/// through the lens. A camera very near a surface, but not on it, still sees it: the place of a floor may be exact in
/// single precision although its corners are far away. A sphere counts as touched only within half of the spacing of
/// floats. first_element: first element of each shape. origin: world position of the compiled scene's (0, 0, 0).
CameraSurface camera_surface(const Flattened& flat, const std::vector<std::int32_t>& first_element,
                             const Camera& camera, Vec3d origin);

/// Whether a placed shape is a quad that encloses the scene: all shapes and media stay on one side of its plane while
/// the shutter is open (up to rounding: 1e-7 of the scene's extent). Example: a wall of a closed room. Such a wall
/// never stands between two points of the scene, so shadow rays need not be tested against it.
bool bounds_scene(const Flattened& flat, std::size_t shape, const Camera& camera);

}  // namespace tyndall
