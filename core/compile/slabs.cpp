#include "core/compile/slabs.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

constexpr double widest_light = 0.5;  // of a light's reach against its distance from the slab
constexpr double contact = 1e-6;      // of the longest half edge: by so much things may overlap without counting

/// The slab with its faces moved outward by `room`.
Block grown(const Slab& p, double room) {
  return {p.middle, {(p.half[0] + room) * p.edge[0], (p.half[1] + room) * p.edge[1], (p.half[2] + room) * p.edge[2]}};
}

/// Returns a thin block around a face of the slab, without the face's rim. side: -1 or 1.
Block face_of(const Slab& p, std::size_t edge, double side, double thin) {
  Block block = grown(p, -10 * thin);
  block.middle = p.middle + side * p.half[edge] * p.edge[edge];
  block.edge[edge] = thin * p.edge[edge];
  return block;
}

std::vector<Vec3d> corners_of(const Slab& p) {
  std::vector<Vec3d> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back(p.middle + (i & 1 ? 1 : -1) * p.half[0] * p.edge[0] + (i & 2 ? 1 : -1) * p.half[1] * p.edge[1] +
                      (i & 4 ? 1 : -1) * p.half[2] * p.edge[2]);
  return corners;
}

double distance_to(const Slab& p, Vec3d point) {
  double squared = 0;
  for (int i = 0; i < 3; ++i) {
    const double out = std::max(std::abs(dot(p.edge[i], point - p.middle)) - p.half[i], 0.0);
    squared += out * out;
  }
  return std::sqrt(squared);
}

/// Whether the surface of a sphere is in the slab or reaches into it, at any time. May wrongly be true.
bool crosses(const Slab& slab, const RoundBody& body, double slack) {
  constexpr int times = 64;
  const int steps = length(body.motion) > 0 ? times : 0;
  const double room = 0.5 * length(body.motion) / times;
  const std::vector<Vec3d> corners = corners_of(slab);
  for (int i = 0; i <= steps; ++i) {
    const Vec3d center = body.center + (static_cast<double>(i) / times) * body.motion;
    const bool holds = std::all_of(corners.begin(), corners.end(),
                                   [&](Vec3d corner) { return length(corner - center) <= body.radius - room + slack; });
    if (!holds && distance_to(slab, center) < body.radius + room - slack) return true;
  }
  return false;
}

/// Whether no sphere reaches into the slab.
bool spheres_keep_out(const Flattened& flat, const Slab& slab, double slack) {
  return std::none_of(flat.shapes.begin(), flat.shapes.end(), [&](const PlacedShape& shape) {
    const auto* sphere = std::get_if<Sphere<>>(&shape.shape);
    return sphere && crosses(slab, round_body(*sphere, shape.placement), slack);
  });
}

/// Whether no flat reaches into the slab. Marks the faces that a flat touches as closed.
bool flats_keep_out(const std::vector<Flat>& flats, Slab& slab, double slack) {
  const double radius = std::hypot(slab.half[0], slab.half[1], slab.half[2]) + slack;
  for (const Flat& flat : flats) {
    if (flat.shape == slab.shape || length(flat.block.middle - slab.middle) > flat.radius + radius) continue;
    if (!are_apart(grown(slab, -slack), flat.block)) return false;
    for (std::size_t i = 0; i < 6; ++i)
      if (!are_apart(face_of(slab, i / 2, i % 2 ? 1 : -1, slack), flat.block)) slab.closed |= 1 << i;
  }
  return true;
}

/// Whether a medium fills the slab completely or leaves it free. If it fills the slab, its density is added to the
/// slab's.
bool is_even(const PlacedVolume& volume, Slab& slab, double slack) {
  const std::vector<Vec3d> corners = corners_of(slab);
  const auto holds = [&](const auto& is_in) { return std::all_of(corners.begin(), corners.end(), is_in); };
  bool filled = false, free = false;
  if (const auto* sphere = std::get_if<Sphere<>>(&volume.boundary)) {
    const RoundBody body = round_body(*sphere, volume.placement);
    filled = holds([&](Vec3d corner) { return length(corner - body.center) <= body.radius + slack; });
    free = distance_to(slab, body.center) >= body.radius - slack;
  } else {
    const Block block = block_of(std::get<Box<>>(volume.boundary), volume.placement);
    filled = holds([&](Vec3d corner) {
      return std::all_of(block.edge.begin(), block.edge.end(), [&](Vec3d e) {
        return std::abs(dot(normalize(e), corner - block.middle)) <= length(e) + slack;
      });
    });
    free = are_apart(grown(slab, -slack), block);
  }
  if (filled) slab.medium_density += volume.medium.density;
  return filled || free;
}

/// Fills in the properties of a slab that depend on its surroundings. Returns false if specular paths cannot pass
/// through it.
bool look_around(const Flattened& flat, const std::vector<Flat>& flats, Slab& slab) {
  const double longest = std::max({slab.half[0], slab.half[1], slab.half[2]}), slack = contact * longest;
  if (std::min({slab.half[0], slab.half[1], slab.half[2]}) < 100 * slack) return false;
  if (!spheres_keep_out(flat, slab, slack) || !flats_keep_out(flats, slab, slack)) return false;
  return std::all_of(flat.volumes.begin(), flat.volumes.end(),
                     [&](const PlacedVolume& volume) { return is_even(volume, slab, slack); });
}

}  // namespace

std::vector<Slab> list_slabs(const Flattened& flat, const std::vector<Flat>& flats, const Scene& scene) {
  std::vector<Slab> list;
  for (std::size_t i = 0; i < flat.shapes.size(); ++i) {
    const PlacedShape& shape = flat.shapes[i];
    const double index = boundary_index(scene.materials[static_cast<std::size_t>(shape.material)].kind);
    const auto* box = std::get_if<Box<>>(&shape.shape);
    if (!box || index < min_slab_index) continue;
    const Block block = block_of(*box, shape.placement);
    Slab slab;
    slab.shape = i, slab.middle = block.middle, slab.index = index;
    for (std::size_t k = 0; k < 3; ++k) {
      slab.half[k] = length(block.edge[k]);
      slab.edge[k] = normalize(block.edge[k]);
    }
    if (look_around(flat, flats, slab)) list.push_back(slab);
  }
  return list;
}

double worth_of(const Slab& slab, const Lights& lights, std::size_t k, Vec3d origin) {
  const Vec3d light = Vec3d{lights.center[0][k], lights.center[1][k], lights.center[2][k]} + origin;
  const double distance = distance_to(slab, light), reach = std::sqrt(static_cast<double>(lights.reach2[k]));
  if (reach > widest_light * distance) return 0;
  double area = 0;  // as seen from the light
  const Vec3d to_light = normalize(slab.middle - light);
  for (int i = 0; i < 3; ++i)
    area += 4 * std::abs(dot(slab.edge[i], to_light)) * slab.half[(i + 1) % 3] * slab.half[(i + 2) % 3];
  return static_cast<double>(lights.power[k]) * std::min(area / (distance * distance), 1.0);
}

void append_numbers(const Slab& p, Vec3d origin, std::vector<float>& numbers) {
  const auto add = [&](double value) { numbers.push_back(static_cast<float>(value)); };
  for (const Vec3d& edge : p.edge) add(edge.x), add(edge.y), add(edge.z);
  for (const Vec3d& edge : p.edge) add(-dot(edge, p.middle - origin));
  for (const double half : p.half) add(half);
  add(p.index), add(p.medium_density), add(p.closed);
}

}  // namespace tyndall
