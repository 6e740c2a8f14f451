#include "core/render/caustics.h"

#include "core/compile/flatten.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

constexpr double least_catch = 0.01;  // share of a light that something smooth has to catch to matter

constexpr std::size_t most_pairs = 1000000;

struct Ball {
  Vec3d center;
  double radius = 0;
};

Ball ball_around(const Extent& extent) {
  Ball ball;
  for (const Vec3d& p : extent.points)
    ball.center = ball.center + (1.0 / static_cast<double>(extent.points.size())) * p;
  for (const Vec3d& p : extent.points) ball.radius = std::max(ball.radius, length(p - ball.center));
  ball.radius += extent.radius;
  return ball;
}

/// Share of all directions from a point that a ball at a distance fills; 1 within it.
double share_of_directions(double radius, double distance) {
  if (radius >= distance) return 1;
  const double sine2 = (radius / distance) * (radius / distance);
  return 0.5 * sine2 / (1 + std::sqrt(1 - sine2));  // (1 - cos) / 2 without cancellation
}

bool is_smooth(const Material& material) {
  const auto* metal = std::get_if<Metal<>>(&material.kind);
  return std::holds_alternative<Dielectric<>>(material.kind) || (metal && metal->fuzz == 0);
}

/// Whether something shows light that comes from anywhere.
bool receives(const Scene& scene, const Flattened& flat) {
  return !flat.volumes.empty() || std::any_of(flat.shapes.begin(), flat.shapes.end(), [&](const PlacedShape& shape) {
    return std::holds_alternative<Lambertian<>>(scene.materials[static_cast<std::size_t>(shape.material)].kind);
  });
}

}  // namespace

double chance_of_caustics(const Scene& scene) {
  const Flattened flat = flatten(scene);
  if (!receives(scene, flat)) return 1;
  std::vector<Ball> lights, smooth;
  for (const PlacedShape& shape : flat.shapes) {
    const Material& material = scene.materials[static_cast<std::size_t>(shape.material)];
    const bool light = std::holds_alternative<Light<>>(material.kind);
    if (light || is_smooth(material)) (light ? lights : smooth).push_back(ball_around(extent_of(shape, scene.camera)));
  }
  // Of very many, some tell enough.
  const std::size_t step = 1 + lights.size() * smooth.size() / most_pairs;
  double least = 1;
  for (const Ball& light : lights)
    for (std::size_t i = 0; i < smooth.size(); i += step) {
      const Ball& thing = smooth[i];
      const double distance = length(light.center - thing.center);
      if (share_of_directions(thing.radius, distance) < least_catch) continue;
      least = std::min(least, share_of_directions(light.radius, distance));
    }
  return least;
}

}  // namespace tyndall
