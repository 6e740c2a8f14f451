#include "core/render/caustics.h"

#include "core/compile/flatten.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tyndall {
namespace {

constexpr double least_catch = 0.01;  // share of a lamp's light that a smooth shape has to catch to matter
constexpr double most_fuzz = 0.05;    // largest fuzz with which metal counts as smooth

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

const Material& material_of(const Scene& scene, const PlacedShape& shape) {
  return scene.materials[static_cast<std::size_t>(shape.material)];
}

bool is_lamp(const Material& material) { return traits_of(material.kind).emits; }

/// Whether it throws light elsewhere, rather than spread it.
bool is_smooth(const Material& material) { return lobe_width(material.kind) < most_fuzz; }

/// A lamp, or a smooth shape that throws a lamp's light elsewhere.
struct Thing {
  std::size_t shape;  // index into Flattened::shapes
  Ball ball;
  double fuzz = 0;
  bool glass = false;
};

struct Things {
  std::vector<Thing> lamps, smooth;
};

Things list_things(const Scene& scene, const Flattened& flat) {
  Things things;
  for (std::size_t i = 0; i < flat.shapes.size(); ++i) {
    const Material& material = material_of(scene, flat.shapes[i]);
    if (!is_lamp(material) && !is_smooth(material)) continue;
    const bool smooth = is_smooth(material), glass = boundary_index(material.kind) > 0;
    const double fuzz = smooth ? lobe_width(material.kind) : 0;
    const Thing thing{i, ball_around(extent_of(flat.shapes[i], scene.camera)), fuzz, glass};
    (is_lamp(material) ? things.lamps : things.smooth).push_back(thing);
  }
  return things;
}

/// The box around a matt surface or a medium. Light from any direction shows there.
struct Receiver {
  Vec3d low, high;
};

Vec3d least_of(Vec3d a, Vec3d b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
Vec3d most_of(Vec3d a, Vec3d b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }

Receiver receiver_around(const Extent& extent) {
  Receiver box{extent.points.front(), extent.points.front()};
  for (const Vec3d& p : extent.points) box = {least_of(box.low, p), most_of(box.high, p)};
  const Vec3d grown{extent.radius, extent.radius, extent.radius};
  return {box.low - grown, box.high + grown};
}

std::vector<Receiver> list_receivers(const Scene& scene, const Flattened& flat) {
  std::vector<Receiver> receivers;
  for (const PlacedVolume& volume : flat.volumes) receivers.push_back(receiver_around(extent_of(volume, scene.camera)));
  for (const PlacedShape& shape : flat.shapes)
    if (traits_of(material_of(scene, shape).kind).diffuse)
      receivers.push_back(receiver_around(extent_of(shape, scene.camera)));
  return receivers;
}

double distance_to_nearest(const std::vector<Receiver>& receivers, Vec3d point) {
  double least = std::numeric_limits<double>::infinity();
  for (const Receiver& box : receivers)
    least = std::min(least, length(most_of(most_of(box.low - point, point - box.high), {0, 0, 0})));
  return least;
}

/// Whether a lamp is within a ball of glass and shines out of it. If the camera is in the ball, too, this is a room and
/// not a bulb.
bool is_bulb(const Thing& lamp, const Thing& thing, Vec3d camera) {
  const Ball& ball = thing.ball;
  return thing.glass && length(lamp.ball.center - ball.center) < ball.radius && lamp.ball.radius < ball.radius &&
         length(camera - ball.center) > ball.radius;
}

}  // namespace

double chance_of_caustics(const Scene& scene, const IsFound& is_found) {
  const auto has = [&](const auto& is) { return std::any_of(scene.materials.begin(), scene.materials.end(), is); };
  if (!has(is_lamp) || !has(is_smooth)) return 1;  // at once, also in a scene of a million spheres
  const Flattened flat = flatten(scene);
  const std::vector<Receiver> receivers = list_receivers(scene, flat);
  if (receivers.empty()) return 1;
  const Things things = list_things(scene, flat);
  const std::size_t step = 1 + things.lamps.size() * things.smooth.size() /
                                   most_pairs;  // of very many pairs only every step-th is looked at
  double least = 1;
  for (const Thing& lamp : things.lamps)
    for (std::size_t i = 0; i < things.smooth.size(); i += step) {
      const Thing& thing = things.smooth[i];
      if (is_found && is_found(lamp.shape, thing.shape)) continue;
      double distance = length(lamp.ball.center - thing.ball.center);
      if (is_bulb(lamp, thing, scene.camera.look_from))
        distance = std::max(thing.ball.radius, distance_to_nearest(receivers, lamp.ball.center));
      else if (share_of_directions(thing.ball.radius, distance) < least_catch)
        continue;
      least = std::min(least, share_of_directions(lamp.ball.radius + thing.fuzz * distance, distance));
    }
  return least;
}

double chance_of_caustics(const Scene& scene, const RenderScene& compiled) {
  const Chains& chains = compiled.chains;
  if (chains.ball.empty()) return chance_of_caustics(scene);
  std::vector<std::size_t> elements{0};  // the first of each shape, and one behind the last
  for (const PlacedShape& shape : flatten(scene).shapes)
    elements.push_back(elements.back() + (std::holds_alternative<Box<>>(shape.shape) ? 6 : 1));
  const std::size_t lights = compiled.lights.kind.size();
  const auto is_pair = [&](std::size_t lamp, std::size_t thing) {
    const std::int32_t light = compiled.elements.light[lamp], ball = chains.ball_of[thing];
    if (light < 0 || ball < 0) return false;
    return chains.pair_of[static_cast<std::size_t>(ball / 2) * lights + static_cast<std::size_t>(light)] >= 0;
  };
  return chance_of_caustics(scene, [&](std::size_t lamp, std::size_t shape) {
    for (std::size_t i = elements[lamp]; i < elements[lamp + 1]; ++i)
      for (std::size_t k = elements[shape]; k < elements[shape + 1]; ++k)
        if (is_pair(i, k)) return true;
    return false;
  });
}

}  // namespace tyndall
