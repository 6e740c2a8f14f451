#pragma once
#include <array>

/// The colours of maps of errors.
namespace tyndall {

/// Black, violet, red, orange, white, linear RGB: brighter all the way, so that it also reads in grey. value in [0, 1],
/// clipped; green for what is not a number.
std::array<float, 3> heat(float value);

}  // namespace tyndall
