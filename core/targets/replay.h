#pragma once
#include "core/trace/scene_view.h"

#include <cstdint>
#include <vector>

/// Follows one path of the scalar kernel event by event, to show how a sample comes about.
namespace tyndall {

enum class Met { nothing, surface, medium };
enum class Fate { goes_on, ends_at_light, escapes, absorbed, roulette, cut, lost };  ///< lost: a value is not finite

/// One point that a path or a branch of it reached, and what that had gathered when it left.
struct PathVertex {
  std::int32_t before = -1;  ///< index of the vertex from which the path came here; -1: the camera
  bool branch = false;       ///< a branch comes here from `before`, and has gathered nothing yet (splitting.h)
  Met met = Met::nothing;
  Fate fate = Fate::goes_on;
  std::int32_t element = -1;  ///< of the surface, or the first one of the medium's boundary
  std::int32_t medium = -1;   ///< index into RenderScene::media
  bool inside = false;        ///< whether the path goes on inside the shape; for a quad, on the side against its normal
  float distance = 0;         ///< from the previous vertex
  Vec3f direction;            ///< unit; in which the path arrived
  Vec3f point;                ///< in RenderScene coordinates
  Vec3f throughput;           ///< on arrival; 1 at the camera
  float kept = 1;             ///< transmittance, since the previous vertex, of media that only absorb: flight.h
  Vec3f radiance;             ///< gathered so far, this vertex included
  Vec3f by_specular_paths;    ///< part of the radiance that specular and guided paths from here have added
  float chance =
      1;  ///< weight of a light hit here, in [0, 1]; specular and guided paths, which find it too, have the rest
  std::uint32_t first_dimension;  ///< first random dimension of the event
};

struct PathReplay {
  Vec3f origin;  ///< where the camera ray starts
  float time = 0;
  std::vector<PathVertex> vertices;  ///< of the path, then of its branches, each up to its end
  /// The sample. Of a path without branches it is, bit for bit, what the scalar kernel adds to the film; else the
  /// kernel adds what the path and each of its branches have gathered at their ends.
  Vec3f radiance;
  float weight = 1;  ///< of the sample, see subpixel_lights.h; the radiances of all vertices include it
  /// The first vertex shares second vertices with seven other pixels (reuse.h): instead of the radiance that leaves its
  /// own second vertex, the sample holds a weighted mean over all eight.
  bool reused = false;
};

/// Follows sample number `sample` of pixel (x, y), in full-image coordinates. It takes the same steps as the kernels.
PathReplay replay(const SceneView& scene, int x, int y, std::uint32_t sample);

}  // namespace tyndall
