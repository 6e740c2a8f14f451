#pragma once
#include "core/trace/scene_view.h"
#include "core/trace/tile_job.h"

namespace tyndall {

/// What sharing second vertices between pixels (reuse.h) changes in a scene, found from a thousand paths. A pure
/// function of the scene without its seed.
struct ReuseGain {
  bool probed = false;  ///< false: too few paths have a second vertex that could be shared
  double variance = 1;  ///< of a sample, over that without sharing
  /// Time of a sample, over that without sharing, as told by the rays: those between the paths count half, because they
  /// only ask whether something is in the way.
  double time = 1;
};
struct ReusedPaths;
using TraceGroups = void (*)(const SceneView& scene, ReusedPaths& paths, TileCounts& counts);
/// trace: follows the paths of groups by the scalar kernel, so that every instruction set gets the same answer.
ReuseGain probe_reuse(const SceneView& scene, TraceGroups trace);

/// Sharing is worth it where the probe promises at most this product of variance and time. The rest is for what the
/// probe does not count, and for its chance.
inline constexpr double worthwhile_product = 0.8;
inline bool is_worthwhile(const ReuseGain& gain) { return gain.variance * gain.time <= worthwhile_product; }

}  // namespace tyndall
