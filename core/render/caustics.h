#pragma once
#include "core/compile/render_scene.h"
#include "core/scene/scene.h"

#include <cstddef>
#include <functional>

/// The probability that BSDF sampling finds the light that glass and polished metal throw on other surfaces. Where it
/// is small, the estimated error is too low, and users are warned (rare.h).
namespace tyndall {

/// Whether specular paths compute the light that comes from a light by way of a shape. Both are indices into
/// Flattened::shapes of the scene.
using IsFound = std::function<bool(std::size_t light, std::size_t shape)>;

/// Glass and polished metal throw light on other surfaces. Shadow rays do not find that light: a path has to hit the
/// light by BSDF sampling, by way of the smooth shape. Returns the smallest probability of that in a scene, in (0, 1]:
/// for each pair of a light and a smooth shape that catches at least a hundredth of its light, the fraction of all
/// directions that the light fills as seen from the shape. 1 if there is no such pair, or no matt surface that would
/// show such light.
/// - A light seen in metal with a little fuzz counts as larger, by the width of the metal's lobe. Shadow rays are sent
/// from such metal, but a path from a wall reaches it by BSDF sampling only. Above a fuzz of 0.05 metal is not smooth.
/// - A light within glass, such as a bulb, shines on everything through it. It counts as seen from the nearest matt
/// surface, or from the glass if that is farther from the light.
/// With fewer than about 2 / chance samples a pixel, most pixels have not met such light at all. Then their two halves
/// agree on a wrong value, and the estimated error is too small.
/// is_found: pairs to leave out; empty: none.
double chance_of_caustics(const Scene& scene, const IsFound& is_found = {});

/// The same without pairs whose light specular paths compute. compiled: made from this scene.
double chance_of_caustics(const Scene& scene, const RenderScene& compiled);

}  // namespace tyndall
