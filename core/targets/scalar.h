#pragma once
#include "core/trace/tile_job.h"

namespace tyndall {

struct ReusedPaths;

/// Follows the paths of groups with the scalar kernel, for probe_reuse(). scene: one with reuses_paths set.
void trace_groups(const SceneView& scene, ReusedPaths& paths, TileCounts& counts);

}  // namespace tyndall
