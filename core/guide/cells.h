#pragma once
#include "core/guide/light_paths.h"

/// Sorts the landings of light paths into cells, and makes lobes of them.
namespace tyndall {

/// Variance times samples, relative to the squared radiance, that BSDF sampling alone is expected to have, from where
/// light paths land: sum over sequences of events of (E of the sequence / E)^2 / (probability to find a light after
/// it). The median over cells, because a few caustics fill
/// little of the picture. All lights count as unshadowed.
double expected_variance(const SceneView& scene, const LightPaths& paths);

/// Fills in the guide's cells and lobes.
void make_cells(const SceneView& scene, const LightPaths& paths, Guide& guide);

}  // namespace tyndall
