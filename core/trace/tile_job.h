#pragma once
#include "core/film/film.h"
#include "core/trace/scene_view.h"

#include <cstdint>

/// The work that kernels are given, and what they count.
namespace tyndall {

/// A tile job: samples [first, last) of the pixels of a tile.
struct TileJob {
  Region tile;        ///< full-image coordinates
  int step = 1;       ///< only pixels whose x and y are multiples of step; step 1: all
  int skip_step = 0;  ///< above 0: skips pixels whose x and y are both multiples of it, which are done already
  std::uint32_t first = 0, last = 0;  ///< sample indices
  /// Null, or for each pixel of the tile, row by row, its own first and last (<= last above) instead of those above.
  const std::uint32_t *first_of = nullptr, *last_of = nullptr;
};

struct TileCounts {
  std::uint64_t rays = 0;         ///< all rays that were traced
  std::uint64_t shadow_rays = 0;  ///< of these, shadow rays, which only test for occlusion
  std::uint64_t steps = 0;        ///< steps that all lanes took together
  std::uint64_t splits = 0;       ///< branches of paths: see core/transport/splitting.h
  ExactSum cut_throughput;  ///< sum, over paths cut off by max_depth, of the brightest channel of their throughput
};

/// One ray to intersect with the scene.
struct TraceRay {
  Vec3f origin, direction;  ///< unit direction, RenderScene coordinates
  float time = 0;
  std::int32_t from = -4;  ///< see Ray::from
};
struct TraceHit {
  float t = 0;                ///< distance; meaningless without a hit
  std::int32_t element = -1;  ///< -1: nothing hit
  bool operator==(const TraceHit&) const = default;
};

/// What is seen first through the centre of a pixel: for selecting objects with the mouse, and for the views.
struct FirstHit {
  std::int32_t element = -1;  ///< -1: nothing, and the other members are 0
  float depth = 0;            ///< distance along the camera's axis
  Vec3f albedo, normal;
};

}  // namespace tyndall
