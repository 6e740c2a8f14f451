#pragma once
#include "core/compile/crowds.h"
#include "core/compile/render_scene.h"

#include <vector>

/// How much of a lamp a ball sees past everything else in the scene.
namespace tyndall {

/// All surfaces of a scene: what may stand in the way.
struct Obstacles {
  std::vector<RoundBody> spheres;
  std::vector<Flat> flats;
};
Obstacles list_obstacles(const Flattened& flat);

/// Share of the straight ways from a lamp to a ball that nothing blocks, in (0, 1], judged by 64 of them. If all are
/// blocked it is 1/64, because others may be open; 1 if the lamp is within the ball. What moves is taken halfway.
/// Spheres that hold an end of a way do not block it: among them are the lamp and the ball; nor do those within the
/// ball. light: index into `lights`; origin: see RenderScene.
double visible_share(const Obstacles& obstacles, const Lights& lights, std::size_t light, Vec3d origin,
                     const RoundBody& ball);

}  // namespace tyndall
