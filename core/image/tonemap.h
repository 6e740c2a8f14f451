#pragma once
#include "core/base/vec.h"

#include <cstdint>
#include <vector>

/// Turns linear light into the 8-bit values of a screen.
namespace tyndall {

enum class ToneCurve { srgb, aces };

/// sRGB's transfer function for linear values in [0, 1], and back (IEC 61966-2-1).
float srgb_encode(float linear);
float srgb_decode(float encoded);

/// 8-bit sRGB of curve(linear · 2^exposure), clipped to [0, 1]; NaN gives 0. rgb: 3 floats a pixel.
/// `aces`: the fit by K. Narkowicz, ACES Filmic Tone Mapping Curve, 2015.
std::vector<std::uint8_t> tone_map(const std::vector<float>& rgb, double exposure, ToneCurve curve);

}  // namespace tyndall
