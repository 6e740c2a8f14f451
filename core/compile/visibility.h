#pragma once
#include "core/compile/overlap.h"
#include "core/compile/render_scene.h"

#include <vector>

/// How much of a light a sphere sees past everything else in the scene.
namespace tyndall {

/// All surfaces of a scene: what may stand in the way.
struct Obstacles {
  std::vector<RoundBody> spheres;
  std::vector<Flat> flats;
};
Obstacles list_obstacles(const Flattened& flat);

/// Fraction of the straight paths from a light to a sphere that nothing blocks, in (0, 1], judged by 64 of them. If all
/// are blocked it is 1/64, because others may be open; 1 if the light is within the sphere. What moves is taken
/// halfway. Spheres that hold an end of a way do not block it: among them are the light and the sphere; nor do those
/// within the sphere. light: index into `lights`; origin: see RenderScene.
double visible_fraction(const Obstacles& obstacles, const Lights& lights, std::size_t light, Vec3d origin,
                        const RoundBody& sphere);

}  // namespace tyndall
