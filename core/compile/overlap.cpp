#include "core/compile/overlap.h"

#include "core/base/sampling.h"
#include "core/compile/columns.h"
#include "core/shapes/outline.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace tyndall {
namespace {

constexpr double touching = 1e-6;  // fraction of the radius by which things may overlap without counting
constexpr int moments = 64;        // number of moments at which a moving sphere is compared with flat shapes

/// Minimum and maximum distance of two moving centres.
struct Distances {
  double minimum, greatest;
};
Distances distances(const RoundBody& a, const RoundBody& b) {
  const Vec3d start = b.center - a.center, relative_motion = b.motion - a.motion;
  const double squared = dot(relative_motion, relative_motion);
  const double nearest = squared > 0 ? std::clamp(-dot(start, relative_motion) / squared, 0.0, 1.0) : 0;
  return {length(start + nearest * relative_motion), std::max(length(start), length(start + relative_motion))};
}

double distance_to_segment(Vec3d point, Vec3d start, Vec3d segment) {
  const double t = std::clamp(dot(point - start, segment) / dot(segment, segment), 0.0, 1.0);
  return length(point - start - t * segment);
}

/// Whether something comes closer to the body's centre than its radius. distance(center): distance of the thing from
/// such a place of the centre. A moving body is tested at `moments` + 1 moments; a thing that could come close between
/// two of them counts as close.
template <class Distance>
bool comes_close(const RoundBody& body, const Distance& distance) {
  const bool moves = length(body.motion) > 0;
  const int count = moves ? moments : 0;
  const double room = moves ? 0.5 * length(body.motion) / moments : 0;
  for (int i = 0; i <= count; ++i) {
    const Vec3d center = body.center + (moves ? static_cast<double>(i) / moments : 0) * body.motion;
    if (distance(center) < body.radius * (1 - touching) + room) return true;
  }
  return false;
}

double distance_to_box(Vec3d p, const Box<>& b) {
  const Vec3d out{std::max({b.min.x - p.x, p.x - b.max.x, 0.0}), std::max({b.min.y - p.y, p.y - b.max.y, 0.0}),
                  std::max({b.min.z - p.z, p.z - b.max.z, 0.0})};
  return length(out);
}

/// A point in a placement's own frame.
Vec3d take_back(const Placement& placement, Vec3d point) {
  return rotate({-placement.degrees, {}}, point - placement.offset);
}

bool reaches_into(const PlacedShape& shape, const RoundBody& body) {
  if (const auto* sphere = std::get_if<Sphere<>>(&shape.shape)) {
    const RoundBody other = round_body(*sphere, shape.placement);
    const Distances d = distances(body, other);
    const double own = body.radius * (1 - touching);
    return d.minimum < own + other.radius && d.greatest > other.radius - own;
  }
  if (const std::optional<Quad<>> quad = frame_of_flat(shape)) {
    const Vec3d corner = place(shape.placement, quad->corner);
    const Vec3d u = rotate(shape.placement, quad->u), v = rotate(shape.placement, quad->v);
    return comes_close(body, [&](Vec3d center) { return distance_to_flat(center, corner, u, v); });
  }
  const auto& box = std::get<Box<>>(shape.shape);
  for (std::int32_t i = 0; i < 6; ++i) {
    const BoxFace face = box_face_edges(box, i);
    const Vec3d corner = place(shape.placement, face.corner);
    const Vec3d u = rotate(shape.placement, face.u), v = rotate(shape.placement, face.v);
    if (comes_close(body, [&](Vec3d center) { return distance_to_flat(center, corner, u, v); })) return true;
  }
  return false;
}

bool reaches_into(const PlacedVolume& volume, const RoundBody& body) {
  if (const auto* sphere = std::get_if<Sphere<>>(&volume.boundary)) {
    const RoundBody other = round_body(*sphere, volume.placement);
    return distances(body, other).minimum < body.radius * (1 - touching) + other.radius;
  }
  const auto& box = std::get<Box<>>(volume.boundary);
  return comes_close(body, [&](Vec3d center) { return distance_to_box(take_back(volume.placement, center), box); });
}

constexpr double flatness = 1e-6;  // of the longer half edge: so far apart two flats count as in one plane
constexpr double parallel = 1e-5;  // sine of the angle between two planes that count as parallel

Flat flat_at(std::size_t shape, const Placement& placement, Vec3d corner, Vec3d u, Vec3d v) {
  const Vec3d half_u = 0.5 * rotate(placement, u), half_v = 0.5 * rotate(placement, v);
  return {shape,
          {place(placement, corner) + half_u + half_v, {half_u, half_v, {0, 0, 0}}},
          length(half_u) + length(half_v)};
}

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

Vec3d light_point_at(const Lights& l, std::size_t k, Vec3d to_sphere, double u, double v) {
  const double width = l.length_u[k], height = l.length_v[k];
  if (l.kind[k] == Lights::sphere) return to_double(l.center[k]) + width * on_disc(to_sphere, u, v);
  return to_double(l.corner[k]) + u * width * to_double(l.edge_u[k]) + v * height * to_double(l.edge_v[k]);
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

double distance_to_flat(Vec3d point, Vec3d corner, Vec3d u, Vec3d v) {
  const Vec3d n = cross(u, v), from = point - corner;
  const double squared = dot(n, n);
  const double a = dot(cross(from, v), n) / squared, b = dot(cross(u, from), n) / squared;
  if (a >= 0 && a <= 1 && b >= 0 && b <= 1) return std::abs(dot(from, n)) / std::sqrt(squared);
  return std::min({distance_to_segment(point, corner, u), distance_to_segment(point, corner, v),
                   distance_to_segment(point, corner + u, v), distance_to_segment(point, corner + v, u)});
}

std::optional<Quad<>> frame_of_flat(const PlacedShape& placed) {
  return std::visit(
      []<class Shape>(const Shape& shape) -> std::optional<Quad<>> {
        if constexpr (std::is_same_v<Shape, Quad<>>)
          return shape;
        else if constexpr (has_outline<Shape>)
          return frame_of(shape);
        else
          return {};
      },
      placed.shape);
}

RoundBody round_body(const Sphere<>& s, const Placement& placement) {
  const Vec3d motion = s.center_end ? rotate(placement, *s.center_end - s.center) : Vec3d{};
  return {place(placement, s.center), motion, std::abs(s.radius)};
}

bool is_overlapped(const Flattened& flat, const RoundBody& body, std::initializer_list<std::size_t> own) {
  for (std::size_t i = 0; i < flat.shapes.size(); ++i)
    if (std::find(own.begin(), own.end(), i) == own.end() && reaches_into(flat.shapes[i], body)) return true;
  return std::any_of(flat.volumes.begin(), flat.volumes.end(),
                     [&](const PlacedVolume& volume) { return reaches_into(volume, body); });
}

Block block_of(const Box<>& b, const Placement& placement) {
  const Vec3d half = 0.5 * (b.max - b.min);
  return {place(placement, 0.5 * (b.min + b.max)),
          {rotate(placement, {half.x, 0, 0}), rotate(placement, {0, half.y, 0}), rotate(placement, {0, 0, half.z})}};
}

/// By the separating axis theorem: S. Gottschalk, M. C. Lin, D. Manocha, OBBTree: A Hierarchical Structure for Rapid
/// Interference Detection, SIGGRAPH 1996.
bool are_apart(const Block& a, const Block& b) {
  const Vec3d segment = b.middle - a.middle;
  const auto separates = [&](Vec3d axis) {
    double room = 0;
    for (const Vec3d& e : a.edge) room += std::abs(dot(axis, e));
    for (const Vec3d& e : b.edge) room += std::abs(dot(axis, e));
    return std::abs(dot(axis, segment)) > room;
  };
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t k = (i + 1) % 3;
    if (separates(cross(a.edge[i], a.edge[k])) || separates(cross(b.edge[i], b.edge[k]))) return true;
    for (const Vec3d& e : b.edge)
      if (separates(cross(a.edge[i], e))) return true;
  }
  return false;
}

std::vector<Flat> list_flats(const Flattened& flat) {
  std::vector<Flat> flats;
  for (std::size_t i = 0; i < flat.shapes.size(); ++i) {
    const PlacedShape& shape = flat.shapes[i];
    if (const std::optional<Quad<>> quad = frame_of_flat(shape))
      flats.push_back(flat_at(i, shape.placement, quad->corner, quad->u, quad->v));
    const auto* box = std::get_if<Box<>>(&shape.shape);
    for (std::int32_t k = 0; box && k < 6; ++k) {
      const BoxFace face = box_face_edges(*box, k);
      flats.push_back(flat_at(i, shape.placement, face.corner, face.u, face.v));
    }
  }
  return flats;
}

bool is_covered(const Block& own, std::size_t shape, const std::vector<Flat>& flats) {
  const double u = length(own.edge[0]), v = length(own.edge[1]), thin = flatness * std::max(u, v);
  const Vec3d normal = normalize(cross(own.edge[0], own.edge[1]));
  const auto shrunk = [&](double edge) { return std::max(1 - 10 * thin / edge, 0.0); };
  const Block block{own.middle, {shrunk(u) * own.edge[0], shrunk(v) * own.edge[1], thin * normal}};
  return std::any_of(flats.begin(), flats.end(), [&](const Flat& other) {
    if (other.shape == shape || length(other.block.middle - own.middle) > other.radius + u + v) return false;
    const Vec3d across = normalize(cross(other.block.edge[0], other.block.edge[1]));
    return length(cross(across, normal)) < parallel && !are_apart(block, other.block);
  });
}

Obstacles list_obstacles(const Flattened& flat) {
  Obstacles list{{}, list_flats(flat)};
  for (const PlacedShape& shape : flat.shapes)
    if (const auto* sphere = std::get_if<Sphere<>>(&shape.shape))
      list.spheres.push_back(round_body(*sphere, shape.placement));
  return list;
}

double visible_fraction(const Obstacles& obstacles, const Lights& lights, std::size_t light, Vec3d origin,
                        const RoundBody& sphere) {
  const Vec3d target = middle_of(sphere), light_center = to_double(lights.center[light]) + origin;
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
