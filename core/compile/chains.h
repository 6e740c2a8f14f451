#pragma once
#include "core/compile/flatten.h"
#include "core/compile/render_scene.h"

/// Which caustics are computed exactly (chains, see core/specular/chain_light.h), and which are left to chance.
namespace tyndall {

/// Pairs of a ball, flat mirror or pane and a lamp. The balls are those that reflect or refract light exactly: metal
/// without fuzz, solid glass, and glass shells, two spheres around one centre, if the same is inside of them as around
/// them. The flat mirrors are quads and faces of boxes, of metal without fuzz. The panes are boxes of glass: see
/// panes.h. The lamps are those whose radius is at most a quarter of their distance from the ball (0.15 of it if they
/// shine through solid glass from outside), or a quarter of the radius of a ball that holds them, or half of their
/// distance from the mirror or pane: larger ones are found by chance about as fast. There are no pairs if no surface or
/// medium of the scene scatters evenly. A pair of a ball is worth less if the ball does not see the whole lamp
/// (sight.h); in scenes of very many pairs and shapes that is not looked at. compiled: the scene with its elements and
/// lights.
Chains find_chains(const Flattened& flat, const Scene& scene, const RenderScene& compiled);

}  // namespace tyndall
