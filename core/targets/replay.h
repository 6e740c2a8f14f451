#pragma once
#include "core/trace/scene_view.h"

#include <cstdint>
#include <vector>

/// Follows one path of the scalar kernel event by event, to show how a sample came about.
namespace tyndall {

enum class Met { nothing, surface, medium };
enum class Fate { goes_on, ends_at_light, escapes, absorbed, roulette, cut, lost };  ///< lost: a value is not finite

/// One place that a path came to, and what it had gathered when it left it.
struct PathVertex {
  Met met = Met::nothing;
  Fate fate = Fate::goes_on;
  std::int32_t element = -1;  ///< that of the surface, or the first one of the medium's boundary
  std::int32_t medium = -1;   ///< index into RenderScene::media
  bool inside = false;        ///< whether the path goes on inside the shape; for a quad, on the side against its normal
  float distance = 0;         ///< from the vertex before
  Vec3f direction;            ///< in which it came, unit
  Vec3f point;                ///< in RenderScene coordinates
  Vec3f throughput;           ///< with which it came; 1 at the camera
  float kept = 1;             ///< by what media that only absorb changed it since the vertex before: flight.h
  Vec3f radiance;             ///< gathered so far, this vertex included
  Vec3f by_specular_paths;    ///< the part of it that exact specular paths from here have added
  float chance =
      1;  ///< weight of a light's power that was found here; specular paths, which find it too, count for the rest
  std::uint32_t first_dimension;  ///< number of the first random dimension of the event
};

struct PathReplay {
  Vec3f origin;  ///< where the camera ray starts
  float time = 0;
  std::vector<PathVertex> vertices;
  Vec3f radiance;    ///< the sample, bit for bit what the scalar kernel gives to the film
  float weight = 1;  ///< of the sample, see subpixel_lights.h; the radiances of all vertices include it
  /// Its first vertex shares second vertices with seven other pixels (reuse.h): instead of what the path has gathered
  /// from its own one, the sample holds a weighted mean of what leaves all eight.
  bool reused = false;
};

/// Follows sample number `sample` of pixel (x, y), in full-image coordinates. It takes the same steps as the kernels.
PathReplay replay(const SceneView& scene, int x, int y, std::uint32_t sample);

}  // namespace tyndall
