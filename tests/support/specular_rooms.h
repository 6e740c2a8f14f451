#pragma once
#include "core/scene/scene.h"

#include <string>
#include <vector>

/// Rooms whose light comes by specular paths alone: a small light hangs in a hood, or in glass, so that no point of the
/// walls sees it. If one kind of specular path is wrong, all of that room's picture is wrong.
namespace tyndall::test {

struct SpecularRoom {
  std::string name;
  Scene scene;
  /// Samples a pixel and seed, and particles, that bring the standard error below `precision` of the mean.
  int spp = 512;
  double precision = 0.003;
  double particles = 1e7;
};

/// One room for each kind of specular path: off metal and glass, through spheres with inner reflections, through shells
/// written both ways and off their inner spheres, out of bulbs, with moving spheres and lights, several lights, quads,
/// boxes and textures as lights, in media and with media within; off flat mirrors; through slabs.
std::vector<SpecularRoom> specular_rooms();

}  // namespace tyndall::test
