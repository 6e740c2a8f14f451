#pragma once
#include "core/compile/overlap.h"
#include "core/compile/render_scene.h"

#include <vector>

/// Estimates how much of a light a sphere sees past the rest of the scene.
namespace tyndall {

/// All surfaces of a scene, which may block a line of sight.
struct Obstacles {
  std::vector<RoundBody> spheres;
  std::vector<Flat> flats;
};
Obstacles list_obstacles(const Flattened& flat);

/// Returns the fraction, in (0, 1], of the lines of sight from a light to a sphere that nothing blocks, estimated from
/// 64 lines. If all 64 are blocked, 1/64, because other lines may be open; 1 if the light is within the sphere. Moving
/// shapes are taken at half time.
///
/// A sphere that holds an end of a line does not block it: for example the light and the sphere themselves. Nor do
/// spheres within the sphere. light: index into `lights`; origin: see RenderScene.
double visible_fraction(const Obstacles& obstacles, const Lights& lights, std::size_t light, Vec3d origin,
                        const RoundBody& sphere);

}  // namespace tyndall
