#pragma once
#include "core/scene/scene.h"

#include <cstdint>
#include <vector>

/// Light traced the other way: particles start at the lights and are joined to the camera wherever they scatter at a
/// matt surface or in media. So they show the light that comes through glass and off mirrors without any special
/// effort, where paths from the camera need chance or specular paths. This shares nothing with the kernels but the
/// scene.
namespace tyndall::test {

struct LightTracing {
  std::uint64_t particles = 1u << 20;
  std::uint64_t seed = 1;
  int batches = 16;  ///< independent parts of the particles
  int threads = 0;   ///< 0: all cores; never changes the picture
};

struct LightTraced {
  int width = 0, height = 0;
  /// Of each batch the mean radiance of all pixels, 3 numbers a pixel, top row first.
  std::vector<std::vector<double>> batches;
  /// By pixel, 1: all that it shows is matt, or media in front of that. Particles cannot be joined to the camera by way
  /// of glass, metal or a light: pixels that show one of those are dark here, and marked 0.
  std::vector<char> joined;
};

/// The picture of a scene with spheres and parallelograms as lights. As few scattering events as the scene's max_depth
/// are followed. Not in a room's light: no shape or camera within a sphere that shines. Throws std::invalid_argument
/// for scenes that LightRoom does not cover.
LightTraced trace_light(const Scene& scene, const LightTracing& how);

}  // namespace tyndall::test
