#include "core/compile/visibility.h"

#include "core/base/sampling.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace tyndall {
namespace {

constexpr int rays = 64;
constexpr double at_start =
    1e-6;  // fraction of a way, from its start, in which flats do not block it: the light is there

Vec3d middle_of(const RoundBody& body) { return body.center + 0.5 * body.motion; }

/// Returns the point (u, v), each in [0, 1), of a unit disc at right angles to a unit direction.
Vec3d on_disc(Vec3d direction, double u, double v) {
  const Basis<double> across = basis_around(direction);
  const Pair<double> place = in_disc(Pair<double>{u, v});
  return place.x * across.s + place.y * across.t;
}

Vec3d column(const std::vector<float> (&of)[3], std::size_t k) { return {of[0][k], of[1][k], of[2][k]}; }

Vec3d light_point_at(const Lights& l, std::size_t k, Vec3d to_sphere, double u, double v) {
  const double width = l.length_u[k], height = l.length_v[k];
  if (l.kind[k] == Lights::sphere) return column(l.center, k) + width * on_disc(to_sphere, u, v);
  return column(l.corner, k) + u * width * column(l.edge_u, k) + v * height * column(l.edge_v, k);
}

bool blocks(const RoundBody& body, Vec3d from, Vec3d segment) {
  const Vec3d to = middle_of(body) - from, beyond = to - segment;
  const double t = std::clamp(dot(to, segment) / dot(segment, segment), 0.0, 1.0), square = body.radius * body.radius;
  const Vec3d apart = to - t * segment;
  return dot(apart, apart) < square && dot(to, to) > square && dot(beyond, beyond) > square;
}

bool blocks(const Flat& flat, Vec3d from, Vec3d segment) {
  const Vec3d u = flat.block.edge[0], v = flat.block.edge[1], normal = cross(u, v), to = flat.block.middle - from;
  const double t = dot(normal, to) / dot(normal, segment), square = dot(normal, normal);
  if (!(t > at_start && t < 1)) return false;
  const Vec3d at = t * segment - to;
  return std::abs(dot(cross(at, v), normal)) < square && std::abs(dot(cross(u, at), normal)) < square;
}

/// Returns the obstacles that are close enough to the lines of sight between two places to block one. reach: largest
/// distance of such a line from the line between the places.
Obstacles list_near(const Obstacles& all, Vec3d from, Vec3d to, double reach) {
  const Vec3d segment = to - from;
  const auto is_near = [&](Vec3d middle, double radius) {
    const double t = std::clamp(dot(middle - from, segment) / dot(segment, segment), 0.0, 1.0);
    return length(middle - from - t * segment) <= radius + reach;
  };
  Obstacles near;
  std::copy_if(all.spheres.begin(), all.spheres.end(), std::back_inserter(near.spheres),
               [&](const RoundBody& body) { return is_near(middle_of(body), body.radius); });
  std::copy_if(all.flats.begin(), all.flats.end(), std::back_inserter(near.flats),
               [&](const Flat& flat) { return is_near(flat.block.middle, flat.radius); });
  return near;
}

bool is_blocked(const Obstacles& obstacles, Vec3d from, Vec3d segment) {
  const auto blocks_segment = [&](const auto& obstacle) { return blocks(obstacle, from, segment); };
  return std::any_of(obstacles.spheres.begin(), obstacles.spheres.end(), blocks_segment) ||
         std::any_of(obstacles.flats.begin(), obstacles.flats.end(), blocks_segment);
}

}  // namespace

Obstacles list_obstacles(const Flattened& flat) {
  Obstacles list{{}, list_flats(flat)};
  for (const PlacedShape& shape : flat.shapes)
    if (const auto* sphere = std::get_if<Sphere<>>(&shape.shape))
      list.spheres.push_back(round_body(*sphere, shape.placement));
  return list;
}

double visible_fraction(const Obstacles& obstacles, const Lights& lights, std::size_t light, Vec3d origin,
                        const RoundBody& sphere) {
  const Vec3d target = middle_of(sphere), light_center = column(lights.center, light) + origin;
  if (length(target - light_center) < sphere.radius) return 1;
  const double light_radius = std::sqrt(static_cast<double>(lights.reach2[light]));
  Obstacles near = list_near(obstacles, light_center, target, std::max(sphere.radius, light_radius));
  std::erase_if(near.spheres,
                [&](const RoundBody& body) { return length(middle_of(body) - target) + body.radius <= sphere.radius; });
  const Vec3d to_sphere = normalize(target - light_center);
  int open = 0;
  for (int i = 0; i < rays; ++i) {
    // Steps by powers of the reciprocal root of x^5 = x + 1 fill four dimensions evenly. M. Roberts, The Unreasonable
    // Effectiveness of Quasirandom Sequences, 2018.
    const auto part = [i](double step) { return std::fmod((i + 0.5) * step, 1.0); };
    const Vec3d from = light_point_at(lights, light, to_sphere, part(0.8566749), part(0.7338919)) + origin;
    const Vec3d to = target + sphere.radius * on_disc(to_sphere, part(0.6287067), part(0.5385973));
    if (!is_blocked(near, from, to - from)) ++open;
  }
  return std::max(open, 1) / static_cast<double>(rays);
}

}  // namespace tyndall
