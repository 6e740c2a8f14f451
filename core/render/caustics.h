#pragma once
#include "core/compile/render_scene.h"
#include "core/scene/scene.h"

#include <cstddef>
#include <functional>

/// How likely a path is to find by chance the light that glass and polished metal throw on other surfaces. Where that
/// is unlikely, the estimated error says too little, and users are warned (rare.h).
namespace tyndall {

/// Whether the light of a lamp that comes by way of a shape is found otherwise than by chance. Both are indices into
/// Flattened::shapes of the scene.
using IsFound = std::function<bool(std::size_t lamp, std::size_t shape)>;

/// Glass and polished metal throw light on other surfaces that sampling the lamps does not find: a path has to meet the
/// lamp by chance. This is the least chance of that, over all pairs of a lamp and a smooth shape that catches at least
/// a hundredth of its light: the share of all directions that the lamp fills as seen from there, in (0, 1]. 1 if there
/// is no such pair, or nothing that scatters evenly and would show such light.
/// - The lobe of metal with a little fuzz makes the lamp appear larger by its own width. Lamps are sampled from there,
///   but a path reaches such metal from a wall only by chance. From a fuzz of 0.05 on, metal is not smooth.
/// - A lamp within glass, such as a bulb, shines on everything through it. It is seen from the nearest surface that
///   scatters evenly, or from the glass if that is farther from the lamp.
/// Until about 2 / chance samples a pixel most pixels have not met such light at all, and their two halves agree on
/// what is wrong.
/// is_found: pairs to be left out; empty: none.
double chance_of_caustics(const Scene& scene, const IsFound& is_found = {});

/// The same without the pairs of a ball and a lamp that chains find. compiled: the scene's own.
double chance_of_caustics(const Scene& scene, const RenderScene& compiled);

}  // namespace tyndall
