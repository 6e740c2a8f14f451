#pragma once
#include "core/compile/render_scene.h"

/// Lamps in fog, whose bright glow needs a way of sampling of its own (see core/kernel/flight.h).
namespace tyndall {

/// The pairs of a medium and a light for which it pays to sample distances along a ray by the angle under which the
/// light sees them. The conditions were found by measuring: where they hold, the same error takes 1.5 to 16 times less
/// time; where they do not, it could take twice as long. The medium scatters and its half width is at most 4 mean free
/// paths; the centre of the light is at most 1.5 half widths from the medium's centre; and the radius of the light is
/// at most a tenth of the medium's half width and of the light's distance to the camera.
NearLamps find_near_lamps(const RenderScene& scene);

}  // namespace tyndall
