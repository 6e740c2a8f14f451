#pragma once
#include "core/guide/things.h"

#include <optional>

/// Light paths from the middles of lights over near-specular surfaces to diffuse ones. They are traced in double, with
/// IEEE operations and square roots only, so that every processor finds the same.
namespace tyndall {

/// How a light path leaves the middle of a light.
struct LightStart {
  Vec3d direction;
  double solid_angle = 0;  ///< of the thing
  double power = 0;        ///< sent into it, by the radiance in this direction
  int light = 0, thing = 0;
  double time = 0;
};

/// Where a light path ends at a diffuse surface.
struct Landing {
  Vec3d point, flight;                 ///< flight: unit, the light's direction there
  Vec3d axis;                          ///< unit, across the flight; matrices are in the frame (axis, flight x axis)
  Symmetric curvature;                 ///< of the wave front from the light's middle
  Symmetric variance;                  ///< of directions: by the light's size and by fuzz
  double weight = 0;                   ///< power that the path carries
  double chance = 1;                   ///< probability that glass sends a path this way
  double length = 0;                   ///< of the path
  OrderedEvents<double> events, next;  ///< as seen from the surface; next: with the first event in the lowest bits
  int count = 0;                       ///< of events
  std::optional<LightImage<double>> image;  ///< where points see the light by way of the same events
  LightStart start;
};

/// The light paths of a scene, and where those end that have landed so far.
struct LightPaths {
  LightPaths(const SceneView& scene, std::vector<Thing> things);

  /// Traces about `count` paths, spread evenly over pairs of a light and a thing.
  void trace_pairs(int count);
  /// Keeps about `count` landings, evenly chosen, with their power, and spreads them over sequences of events as
  /// trace_copies() does, with at least ten of each sequence that has so many.
  void thin_out(std::size_t count);
  /// Traces about `count` copies of the paths that have landed, rotated a little, and spreads them over sequences of
  /// events by the roots of their powers.
  void trace_copies(int count);

  const SceneView& scene;
  std::vector<Thing> things;
  std::vector<std::int32_t> thing_of;  ///< by element; -1: none
  std::vector<Landing> landings;
  double paths_of_pair = 0;                      ///< what the sum of weights is to be divided by
  int traced = 0;                                ///< number of paths
  std::uint64_t random = 0x2545f4914f6cdd1dull;  ///< state of the random numbers
};

}  // namespace tyndall
