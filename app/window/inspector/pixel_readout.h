#pragma once
#include "core/render/frame.h"
#include "core/scene/scene.h"

#include <array>
#include <string>
#include <vector>

/// This room looks closer at the picture: at one pixel and at the path that makes it noisy, at what the colours of a
/// view mean, and at a rectangle that is refined first.
namespace tyndall {

/// What is seen at a pixel.
struct SeenThing {
  std::string object, material;  ///< "": nothing
  double depth = 0;              ///< along the camera's axis
};

/// What the inspector says.
struct PixelReadout {
  std::vector<std::string> lines;
  std::array<float, 3> shown{};  ///< the colour on the screen, in [0, 1]
};

/// frame: on the screen; report: on this pixel, or samples 0; seen: there.
PixelReadout pixel_readout(const Frame& frame, const PixelReport& report, const SeenThing& seen,
                           const Display& display);

}  // namespace tyndall
