#pragma once
#include "core/image/image_io.h"

#include <array>
#include <vector>

/// Errors of pixels as a picture.
namespace tyndall {

/// Rows beneath a heat map for its scale.
inline constexpr int heat_scale_rows = 26;

/// The values in colour, and beneath them the scale from 0 to 1, marked at 0, 0.5 and 1, if it is wanted. values: width
/// x height, top row first.
LinearImage heat_map(const std::vector<float>& values, int width, int height, bool with_scale = true);

/// Black, violet, red, orange, white, linear RGB: brighter all the way, so that it also reads in grey. value in [0, 1],
/// clipped; green for what is not a number.
std::array<float, 3> heat(float value);

}  // namespace tyndall
