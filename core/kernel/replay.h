#pragma once
#include "core/kernel/scene_view.h"

#include <cstdint>
#include <vector>

/// One path of the scalar kernel, event by event, to see how a sample came about.
namespace tyndall {

enum class Met { nothing, surface, medium };
enum class Fate { goes_on, ends_at_light, escapes, absorbed, roulette, cut, lost };  ///< lost: no number any more

/// Where a path went, and what it had gathered when it left.
struct PathVertex {
  Met met = Met::nothing;
  Fate fate = Fate::goes_on;
  std::int32_t element = -1;  ///< of the surface, or the first of the medium's boundary
  std::int32_t medium = -1;   ///< index into RenderScene::media
  bool inside = false;        ///< whether the path goes on inside the shape; for a quad, on the side against its normal
  float distance = 0;         ///< from the vertex before
  Vec3f direction;            ///< by which it came, unit
  Vec3f point;                ///< RenderScene coordinates
  Vec3f throughput;           ///< with which it came
  Vec3f radiance;             ///< gathered so far, this vertex included
  Vec3f by_chains;            ///< what exact chains from here added to it
  float chance = 1;  ///< share of a lamp's light that counts here; the rest is left to chains, which find it too
  std::uint32_t first_dimension;  ///< of the event's random numbers
};

struct PathReplay {
  Vec3f origin;  ///< where the camera ray starts
  float time = 0;
  std::vector<PathVertex> vertices;
  Vec3f radiance;  ///< the sample, bit for bit what the scalar kernel gives to the film
};

/// Follows sample `sample` of pixel (x, y), full-image coordinates, by the kernels' own step.
PathReplay replay(const SceneView& scene, int x, int y, std::uint32_t sample);

}  // namespace tyndall
