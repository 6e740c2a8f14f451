#pragma once
#include "core/compile/render_scene.h"

/// The sun in a picture of the sky.
namespace tyndall {

/// Finds the brightest spot of a picture of the sky, if it is small and gives enough of the sky's light for specular
/// paths to be worth their time. irradiance: of the whole sky, as SkyDistribution has it. Its `tangent` is 0 if the
/// picture has no such spot.
SkySun find_sun(const Image::Pixels& pixels, double irradiance);

}  // namespace tyndall
