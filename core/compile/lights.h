#pragma once
#include "core/compile/flatten.h"
#include "core/compile/render_scene.h"

/// The lights that integrators sample.
namespace tyndall {

/// Collects the emitting primitives of a scene and enters them into elements.light. first_element: for each shape of
/// `flat` the number of its first element. Lights of power 0 are left out: rays meet them as black surfaces.
Lights collect_lights(const Scene& scene, const Flattened& flat, const std::vector<std::int32_t>& first_element,
                      Vec3d origin, Elements& elements);

/// Fills `tree` from center, power and reach2 if there are more than most_lights_by_contribution. Ranges are split
/// where the sum of both sides' power times squared extent is least. After A. Conty Estevez, C. Kulla, Importance
/// Sampling of Many Lights with Adaptive Tree Splitting, PACMCGIT 1(2), 2018; lights here shine to all sides.
void build_light_tree(Lights& lights);

}  // namespace tyndall
