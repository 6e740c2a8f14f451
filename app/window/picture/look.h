#pragma once
#include "core/scene/scene.h"

#include <cstdint>
#include <vector>

/// This room puts rendered pictures on the screen.
namespace tyndall {

/// How the picture is shown.
struct Look {
  double exposure = 0;  ///< stops
  ToneMap tone_map = ToneMap::srgb;
  bool dither = false;
  bool stops = false;  ///< luminance in colours, see stops.h, in place of the curve
  bool operator==(const Look&) const = default;
};

/// What the screen shows of linear light, as a PNG of it would: `rgba` has 4 floats a pixel, of which the last is not
/// read, `bytes` gets 4, the last is 255. width: pixels a row.
void screen_bytes(const std::vector<float>& rgba, int width, const Look& look, std::vector<std::uint8_t>& bytes);

}  // namespace tyndall
