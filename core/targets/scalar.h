#pragma once
#include "core/trace/work.h"

namespace tyndall {

struct SharedPaths;

/// Follows the paths of groups by the scalar kernel, for probe_sharing(). scene: one that shares.
void trace_groups(const SceneView& scene, SharedPaths& paths, UnitCounts& counts);

}  // namespace tyndall
