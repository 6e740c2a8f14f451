#pragma once
#include "core/image/image.h"

#include <cstddef>
#include <string>

/// Finds values of pictures that are not finite: NaN and infinities. NaN equals nothing, not even itself.
namespace tyndall {

/// Whether the pixel of that index, top row first, is finite in all channels.
bool is_finite(const LinearImage& image, std::size_t pixel);

/// "3 of 256 pixels are not finite, the first at 5,0 (red is nan)"; empty if all values are finite.
std::string not_finite_text(const LinearImage& image);

}  // namespace tyndall
