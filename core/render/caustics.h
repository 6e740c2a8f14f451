#pragma once
#include "core/scene/scene.h"

namespace tyndall {

/// Light that smooth glass and mirrors throw on other things is not found by sampling lights: a path has to meet the
/// light by chance. The least chance of that among the lights that shine on something smooth: the share of all
/// directions that the light fills as seen from there, in (0, 1]. 1 if there is nothing of the kind.
/// Until about 2 / chance samples a pixel most pixels have not met such light at all, and their two halves agree on
/// what is wrong.
double chance_of_caustics(const Scene& scene);

}  // namespace tyndall
