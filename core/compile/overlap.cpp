#include "core/compile/overlap.h"

#include "core/base/sampling.h"
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
  const int count = length(body.motion) > 0 ? moments : 0;
  const double room = 0.5 * length(body.motion) / moments;
  for (int i = 0; i <= count; ++i) {
    const Vec3d center = body.center + (static_cast<double>(i) / moments) * body.motion;
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
  bool reaches = false;
  each_face(shape, [&](const BoxFace& face, std::int32_t) {
    reaches = reaches ||
              comes_close(body, [&](Vec3d center) { return distance_to_flat(center, face.corner, face.u, face.v); });
  });
  return reaches;
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

constexpr int rays = 64;
constexpr double at_start = 1e-6;  // fraction of a line in which flats do not block it: the light is there

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

bool is_sphere(const Flat& obstacle) { return obstacle.block.edge[0] == Vec3d{}; }

bool blocks(const Flat& obstacle, Vec3d from, Vec3d segment) {
  const Vec3d u = obstacle.block.edge[0], v = obstacle.block.edge[1], to = obstacle.block.middle - from;
  if (is_sphere(obstacle)) {
    const double t = std::clamp(dot(to, segment) / dot(segment, segment), 0.0, 1.0);
    const double square = obstacle.radius * obstacle.radius;
    const Vec3d apart = to - t * segment, beyond = to - segment;
    return dot(apart, apart) < square && dot(to, to) > square && dot(beyond, beyond) > square;
  }
  const Vec3d normal = cross(u, v);
  const double t = dot(normal, to) / dot(normal, segment), square = dot(normal, normal);
  if (!(t > at_start && t < 1)) return false;
  const Vec3d at = t * segment - to;
  return std::abs(dot(cross(at, v), normal)) < square && std::abs(dot(cross(u, at), normal)) < square;
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
  for (std::size_t i = 0; i < flat.shapes.size(); ++i)
    each_face(flat.shapes[i], [&](const BoxFace& face, std::int32_t) {
      const Vec3d u = 0.5 * face.u, v = 0.5 * face.v;
      flats.push_back({i, {face.corner + u + v, {u, v, {0, 0, 0}}}, length(u) + length(v)});
    });
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

std::vector<std::int32_t> plane_numbers(const Flattened& flat) {
  struct Face {
    std::array<double, 4> plane;  ///< unit normal to one of both sides, and distance from the origin, in units of each
    std::size_t shape, element;
  };
  constexpr double unit = 0x1p-30;
  double size = 1e-300;
  std::vector<Face> faces;
  std::vector<std::int32_t> numbers;
  for (std::size_t i = 0; i < flat.shapes.size(); ++i) {
    const std::size_t first = numbers.size();
    numbers.resize(first + (std::holds_alternative<Box<>>(flat.shapes[i].shape) ? 6 : 1), -1);
    each_face(flat.shapes[i], [&](const BoxFace& face, std::int32_t k) {
      const Vec3d n = (1 / unit) * face.normal;
      const double x = std::round(n.x), y = std::round(n.y), z = std::round(n.z),
                   distance = dot(face.normal, face.corner);
      if (!std::isfinite(x + y + z + distance)) return;
      const double side = std::array{x, y, z, 0.0} < std::array{-x, -y, -z, 0.0} ? -1 : 1;
      faces.push_back({{side * x, side * y, side * z, side * distance / unit}, i, first + static_cast<std::size_t>(k)});
      size = std::max(size, length(face.corner));
    });
  }
  for (Face& one : faces) one.plane[3] = std::round(one.plane[3] / size);
  std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) { return a.plane < b.plane; });
  bool some = false;
  for (auto from = faces.begin(), to = from; from != faces.end(); from = to) {
    to = std::find_if(from, faces.end(), [&](const Face& one) { return one.plane != from->plane; });
    if (std::all_of(from, to, [&](const Face& one) { return one.shape == from->shape; })) continue;
    some = true;
    std::for_each(from, to, [&](const Face& one) {
      numbers[one.element] = static_cast<std::int32_t>(2 * (from - faces.begin())) +
                             (std::holds_alternative<Box<>>(flat.shapes[one.shape].shape) ? 1 : 0);
    });
  }
  if (!some) numbers.clear();
  return numbers;
}

std::optional<Flattened> set_glass_apart(const Flattened& flat, const std::vector<Material>& materials, Vec3d origin) {
  const auto is_glass = [&](const PlacedShape& one) {
    return std::holds_alternative<Box<>>(one.shape) &&
           boundary_index(materials[static_cast<std::size_t>(one.material)].kind) != 0;
  };
  if (std::none_of(flat.shapes.begin(), flat.shapes.end(), is_glass)) return {};
  const std::vector<std::int32_t> numbers = plane_numbers(flat), first = first_elements(flat);
  std::optional<Flattened> apart;
  double size = 0;
  for (const bool moves : {false, true})
    for (std::size_t i = 0; i < flat.shapes.size() && !numbers.empty(); ++i) {
      const PlacedShape& one = flat.shapes[i];
      if (!is_glass(one)) continue;
      const auto& box = std::get<Box<>>(one.shape);
      for (int face = 0; face < 6; ++face) {
        if (numbers[static_cast<std::size_t>(first[i] + face)] < 0) continue;
        size = std::max(size, length(center_of(one) - origin) + length(box.max - box.min));
        if (!moves) continue;
        if (!apart) apart = flat;
        auto& smaller = std::get<Box<>>(apart->shapes[i].shape);
        const Vec3d normal = box_face_edges(box, face).normal;
        const double hair = std::min(0x1p-19 * size, 0.1 * std::abs(dot(normal, box.max - box.min)));
        Vec3d& corner = face % 2 ? smaller.max : smaller.min;
        corner = corner - hair * normal;
        for (PlacedVolume& within : apart->volumes)
          if (within.surface == static_cast<int>(i)) within.boundary = smaller;
      }
    }
  return apart;
}

Obstacles list_obstacles(const Flattened& flat) {
  Obstacles list = list_flats(flat);
  for (std::size_t i = 0; i < flat.shapes.size(); ++i)
    if (const auto* sphere = std::get_if<Sphere<>>(&flat.shapes[i].shape)) {
      const RoundBody body = round_body(*sphere, flat.shapes[i].placement);
      list.push_back({i, {middle_of(body), {}}, body.radius});
    }
  return list;
}

double visible_fraction(const Obstacles& obstacles, const Lights& lights, std::size_t light, Vec3d origin,
                        const RoundBody& sphere) {
  const Vec3d target = middle_of(sphere), light_center = to_double(lights.center[light]) + origin;
  if (length(target - light_center) < sphere.radius) return 1;
  // The lines are at most so far from the line between the middles.
  const double reach = std::max(sphere.radius, std::sqrt(static_cast<double>(lights.reach2[light])));
  Obstacles near;
  std::copy_if(obstacles.begin(), obstacles.end(), std::back_inserter(near), [&](const Flat& one) {
    const Vec3d middle = one.block.middle;
    if (is_sphere(one) && length(middle - target) + one.radius <= sphere.radius) return false;
    return distance_to_segment(middle, light_center, target - light_center) <= one.radius + reach;
  });
  const Vec3d to_sphere = normalize(target - light_center);
  int open = 0;
  for (int i = 0; i < rays; ++i) {
    // Steps by powers of the reciprocal root of x^5 = x + 1 fill four dimensions evenly. M. Roberts, The Unreasonable
    // Effectiveness of Quasirandom Sequences, 2018.
    const auto part = [i](double step) { return std::fmod((i + 0.5) * step, 1.0); };
    const Vec3d from = light_point_at(lights, light, to_sphere, part(0.8566749), part(0.7338919)) + origin;
    const Vec3d to = target + sphere.radius * on_disc(to_sphere, part(0.6287067), part(0.5385973));
    if (std::none_of(near.begin(), near.end(), [&](const Flat& one) { return blocks(one, from, to - from); })) ++open;
  }
  return std::max(open, 1) / static_cast<double>(rays);
}

}  // namespace tyndall
