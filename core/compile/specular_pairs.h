#pragma once
#include "core/compile/flatten.h"
#include "core/compile/render_scene.h"

/// Which caustics are computed exactly (specular paths, see core/specular/specular_light.h), and which are left to
/// chance.
namespace tyndall {

/// Pairs of a sphere, flat mirror or slab and a light. The spheres are those that reflect or refract light exactly:
/// metal without fuzz, solid glass, and glass shells, two spheres around one centre, if the same is inside of them as
/// around them. The flat mirrors are quads and faces of boxes, of metal without fuzz. The slabs are boxes of glass: see
/// slabs.h. The lights are those whose radius is at most a quarter of their distance from the sphere (0.15 of it if
/// they shine through solid glass from outside), or a quarter of the radius of a sphere that holds them, or half of
/// their distance from the mirror or slab: larger ones are found by BSDF sampling about as fast. There are no pairs if
/// no surface or medium of the scene scatters evenly. A pair of a sphere is worth less if the sphere does not see the
/// whole light (visibility.h); in scenes of very many pairs and shapes that is not looked at. compiled: the scene with
/// its elements and lights.
SpecularPairs find_specular_pairs(const Flattened& flat, const Scene& scene, const RenderScene& compiled);

}  // namespace tyndall
