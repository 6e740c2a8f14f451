#pragma once
#include "core/compile/sky_texels.h"

/// The sun in a picture of the sky.
namespace tyndall {

/// Finds the brightest spot of a picture of the sky if it is small; else returns a sun whose tangent is 0. Its
/// irradiance is left at 0.
SkySun find_sun(const SkyTexels& texels);

/// Whether a direction (unit, before the sky's turn) lies in the sun's square.
inline bool is_in_sun(const SkySun& sun, Vec3d direction) {
  const double reach = sun.tangent * dot(direction, sun.axis);
  return std::abs(dot(direction, sun.edge_u)) < reach && std::abs(dot(direction, sun.edge_v)) < reach;
}

/// False for rows of texels, of `rows` from the top, that is_in_sun() need not be asked about.
bool row_has_sun(const SkySun& sun, int row, int rows);

}  // namespace tyndall
