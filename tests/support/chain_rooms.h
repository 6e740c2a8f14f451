#pragma once
#include "core/scene/scene.h"

#include <string>
#include <vector>

/// Rooms whose light comes by chains alone: a small lamp hangs in a hood, or in glass, so that no point of the walls
/// sees it. If one kind of chain is wrong, all of that room's picture is wrong.
namespace tyndall::test {

struct ChainRoom {
  std::string name;
  Scene scene;
  /// Samples a pixel and seed, and particles, that bring the standard error below `precision` of the mean.
  int spp = 512;
  double precision = 0.003;
  double particles = 1e7;
};

/// One room for each kind of chain: off metal and glass, through balls with inner reflections, through shells written
/// both ways and off their inner spheres, out of bulbs, with moving balls and lamps, several lamps, quads, boxes and
/// textures as lamps, in fog and with fog within; off flat mirrors; through panes.
std::vector<ChainRoom> chain_rooms();

}  // namespace tyndall::test
