#pragma once
#include "core/film/film.h"
#include "core/trace/scene_view.h"

#include <cstdint>

/// What kernels are given to do, and what they count.
namespace tyndall {

/// A tile job: samples [first, last) of the pixels of a tile.
struct TileJob {
  Region tile;        ///< full-image coordinates
  int step = 1;       ///< only pixels whose x and y are multiples of step; step 1: all
  int skip_step = 0;  ///< above 0: leaves out pixels whose x and y are both multiples of it, which are done already
  std::uint32_t first = 0, last = 0;  ///< sample indices
  /// Null, or for each pixel of the tile, row by row, its own first and last (<= last) in place of those above.
  const std::uint32_t *first_of = nullptr, *last_of = nullptr;
};

struct TileCounts {
  std::uint64_t rays = 0;         ///< all rays that were traced
  std::uint64_t shadow_rays = 0;  ///< those of them that only asked whether something is in the way
  std::uint64_t steps = 0;        ///< how often all lanes together were taken a step further
  ExactSum cut_throughput;        ///< sum over paths that max_depth cut off: their throughput's brightest channel
};

/// One ray for `trace`.
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

/// What is seen first through the centre of a pixel: for selecting objects with the mouse and for the views.
struct FirstHit {
  std::int32_t element = -1;  ///< -1: nothing; the other values then are 0
  float depth = 0;            ///< distance along the camera's axis
  Vec3f albedo, normal;
};

}  // namespace tyndall
