#pragma once
#include "core/scene/scene.h"

#include <vector>

/// The parts of an edit's latency that cannot be seen from outside the renderer.
namespace tyndall::bench {

/// Seconds that compile() takes from one scene to the next, `repeat` times, what is equal kept.
std::vector<double> compile_times(const Scene& from, const Scene& to, int repeat);

/// Seconds from asking a pass that is running on all cores to give up until it has, `repeat` times at different
/// moments, with passes of 1 and of 16 samples in turn.
std::vector<double> give_way_times(const Scene& scene, int repeat);

}  // namespace tyndall::bench
