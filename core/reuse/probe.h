#pragma once
#include "core/trace/scene_view.h"
#include "core/trace/tile_job.h"

namespace tyndall {

/// What reuse of second vertices between pixels (reuse.h) changes in a scene, measured with about a thousand paths. A
/// pure function of the scene without its seed.
struct ReuseGain {
  bool probed = false;  ///< false: too few paths have a second vertex that could be reused
  double variance = 1;  ///< variance of a sample, over that without reuse
  /// Time of a sample, over that without reuse, estimated from the rays: rays between paths count half, because they
  /// only test for occlusion.
  double time = 1;
};
struct ReusedPaths;
using TraceGroups = void (*)(const SceneView& scene, ReusedPaths& paths, TileCounts& counts);
/// trace: follows the paths of groups with the scalar kernel, so that every instruction set gets the same result.
ReuseGain probe_reuse(const SceneView& scene, TraceGroups trace);

/// Reuse is worth it where the probe's product of variance and time is at most this. The margin up to 1 covers what the
/// probe does not count, and its noise.
inline constexpr double worthwhile_product = 0.8;
inline bool is_worthwhile(const ReuseGain& gain) { return gain.variance * gain.time <= worthwhile_product; }

}  // namespace tyndall
