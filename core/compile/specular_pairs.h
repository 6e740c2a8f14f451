#pragma once
#include "core/compile/flatten.h"
#include "core/compile/render_scene.h"

/// Chooses the caustics that are solved for exactly (specular paths by manifold next event estimation, see
/// core/specular/specular_light.h). All other caustics are left to BSDF sampling.
namespace tyndall {

/// Returns the pairs of a specular object (sphere, flat mirror or slab) and a light whose specular paths are solved
/// for; no pairs if no surface or medium of the scene is diffuse. compiled: the scene with its elements and lights.
///
/// - Spheres: metal without fuzz, solid glass, and glass shells (two spheres around one centre) with the same medium
/// inside as outside.
/// - Flat mirrors: quads and faces of boxes, of metal without fuzz; not triangles and disks.
/// - Slabs: boxes of glass, see flat_objects.h.
/// - Lights: the radius of the light is at most 1/4 of its distance from the sphere (0.15 of it if it shines through
/// solid glass from outside), or 1/4 of the radius of a sphere around it, or 1/2 of its distance from the mirror or
/// slab. BSDF sampling finds larger lights about as fast.
///
/// A pair is worth less if its sphere does not see the whole light (visible_fraction); this is not tested in scenes of
/// very many pairs and shapes.
SpecularPairs find_specular_pairs(const Flattened& flat, const Scene& scene, const RenderScene& compiled);

}  // namespace tyndall
