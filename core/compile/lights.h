#pragma once
#include "core/compile/flatten.h"
#include "core/compile/render_scene.h"

/// The lights that integrators sample.
namespace tyndall {

/// Collects the emitting primitives of a scene and enters them into elements.light. first_element: for each shape of
/// `flat` the number of its first element. Lights of power 0 are left out: rays meet them as black surfaces.
Lights collect_lights(const Scene& scene, const Flattened& flat, const std::vector<std::int32_t>& first_element,
                      Vec3d origin, Elements& elements);

/// Fills probability, keep and alias from power. M. Vose, A Linear Algorithm for Generating Random Numbers with a Given
/// Distribution, 1991.
void build_alias_table(Lights& lights);

}  // namespace tyndall
