#pragma once
#include "core/compile/flatten.h"
#include "core/compile/render_scene.h"

namespace tyndall {

/// Balls that bend or mirror light exactly (metal without fuzz, glass, shells of two concentric spheres of glass that
/// hold what is around them) and the lamps that are small as seen from them: at most a quarter of their distance, or of
/// the radius of a ball that holds them. Larger lamps are found by chance about as fast. `scene`: with its elements and
/// lights. None where nothing scatters evenly.
Chains find_chains(const Flattened& flat, const Scene& scene, const RenderScene& compiled);

}  // namespace tyndall
