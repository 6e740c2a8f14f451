#include "core/compile/panes.h"

#include "core/compile/columns.h"
#include "core/compile/crowds.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tyndall {
namespace {

constexpr double widest_lamp = 0.5;  // of a lamp's reach against its distance from the pane
constexpr double contact = 1e-6;     // of the longest half edge: by so much things may overlap without counting

/// A box of any directions, or a parallelogram: all middle + a edge[0] + b edge[1] + c edge[2] for a, b, c in [-1, 1].
struct Block {
  Vec3d middle;
  std::array<Vec3d, 3> edge;
};

/// The pane with its faces moved outward by `grown`.
Block block_of(const Pane& p, double grown) {
  return {p.middle,
          {(p.half[0] + grown) * p.edge[0], (p.half[1] + grown) * p.edge[1], (p.half[2] + grown) * p.edge[2]}};
}

/// A thin block around a face of the pane, which leaves its rim out. side: -1, 1.
Block face_of(const Pane& p, std::size_t edge, double side, double thin) {
  Block block = block_of(p, -10 * thin);
  block.middle = p.middle + side * p.half[edge] * p.edge[edge];
  block.edge[edge] = thin * p.edge[edge];
  return block;
}

Block flat_block(const Placement& placement, Vec3d corner, Vec3d u, Vec3d v) {
  const Vec3d half_u = 0.5 * turn(placement, u), half_v = 0.5 * turn(placement, v);
  return {place(placement, corner) + half_u + half_v, {half_u, half_v, {0, 0, 0}}};
}

Block box_block(const Placement& placement, const Box<>& b) {
  const Vec3d half = 0.5 * (b.max - b.min);
  return {place(placement, 0.5 * (b.min + b.max)),
          {turn(placement, {half.x, 0, 0}), turn(placement, {0, half.y, 0}), turn(placement, {0, 0, half.z})}};
}

/// Whether two blocks have no point in common, by the theorem of the separating axis: S. Gottschalk, M. C. Lin,
/// D. Manocha, OBBTree: A Hierarchical Structure for Rapid Interference Detection, SIGGRAPH 1996.
bool are_apart(const Block& a, const Block& b) {
  const Vec3d way = b.middle - a.middle;
  const auto separates = [&](Vec3d axis) {
    double room = 0;
    for (const Vec3d& e : a.edge) room += std::abs(dot(axis, e));
    for (const Vec3d& e : b.edge) room += std::abs(dot(axis, e));
    return std::abs(dot(axis, way)) > room;
  };
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t k = (i + 1) % 3;
    if (separates(cross(a.edge[i], a.edge[k])) || separates(cross(b.edge[i], b.edge[k]))) return true;
    for (const Vec3d& e : b.edge)
      if (separates(cross(a.edge[i], e))) return true;
  }
  return false;
}

std::vector<Vec3d> corners_of(const Pane& p) {
  std::vector<Vec3d> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back(p.middle + (i & 1 ? 1 : -1) * p.half[0] * p.edge[0] + (i & 2 ? 1 : -1) * p.half[1] * p.edge[1] +
                      (i & 4 ? 1 : -1) * p.half[2] * p.edge[2]);
  return corners;
}

double distance_to(const Pane& p, Vec3d point) {
  double squared = 0;
  for (int i = 0; i < 3; ++i) {
    const double out = std::max(std::abs(dot(p.edge[i], point - p.middle)) - p.half[i], 0.0);
    squared += out * out;
  }
  return std::sqrt(squared);
}

/// Whether the surface of a sphere is in the pane or reaches into it, at any time. May be yes too often.
bool crosses(const Pane& pane, const RoundBody& body, double slack) {
  constexpr int times = 64;
  const int steps = length(body.way) > 0 ? times : 0;
  const double room = 0.5 * length(body.way) / times;
  const std::vector<Vec3d> corners = corners_of(pane);
  for (int i = 0; i <= steps; ++i) {
    const Vec3d center = body.center + (static_cast<double>(i) / times) * body.way;
    const bool holds = std::all_of(corners.begin(), corners.end(),
                                   [&](Vec3d corner) { return length(corner - center) <= body.radius - room + slack; });
    if (!holds && distance_to(pane, center) < body.radius + room - slack) return true;
  }
  return false;
}

/// The parallelograms that a quad or box is made of.
std::vector<Block> flats_of(const PlacedShape& shape) {
  if (const auto* quad = std::get_if<Quad<>>(&shape.shape))
    return {flat_block(shape.placement, quad->corner, quad->u, quad->v)};
  std::vector<Block> faces;
  for (std::int32_t i = 0; i < 6; ++i) {
    const BoxFace face = box_face_edges(std::get<Box<>>(shape.shape), i);
    faces.push_back(flat_block(shape.placement, face.corner, face.u, face.v));
  }
  return faces;
}

/// Whether a shape leaves the pane's inside free. Faces that it touches are marked as closed.
bool keeps_out(const PlacedShape& shape, Pane& pane, double slack) {
  if (const auto* sphere = std::get_if<Sphere<>>(&shape.shape))
    return !crosses(pane, round_body(*sphere, shape.placement), slack);
  for (const Block& flat : flats_of(shape)) {
    if (!are_apart(block_of(pane, -slack), flat)) return false;
    for (std::size_t i = 0; i < 6; ++i)
      if (!are_apart(face_of(pane, i / 2, i % 2 ? 1 : -1, slack), flat)) pane.closed |= 1 << i;
  }
  return true;
}

/// Whether a medium fills the pane or leaves it free. If it fills it, its density is added to the pane's fog.
bool is_even(const PlacedVolume& volume, Pane& pane, double slack) {
  const std::vector<Vec3d> corners = corners_of(pane);
  const auto holds = [&](const auto& is_in) { return std::all_of(corners.begin(), corners.end(), is_in); };
  bool filled = false, free = false;
  if (const auto* sphere = std::get_if<Sphere<>>(&volume.boundary)) {
    const RoundBody body = round_body(*sphere, volume.placement);
    filled = holds([&](Vec3d corner) { return length(corner - body.center) <= body.radius + slack; });
    free = distance_to(pane, body.center) >= body.radius - slack;
  } else {
    const Block block = box_block(volume.placement, std::get<Box<>>(volume.boundary));
    filled = holds([&](Vec3d corner) {
      return std::all_of(block.edge.begin(), block.edge.end(), [&](Vec3d e) {
        return std::abs(dot(normalize(e), corner - block.middle)) <= length(e) + slack;
      });
    });
    free = are_apart(block_of(pane, -slack), block);
  }
  if (filled) pane.fog += volume.medium.density;
  return filled || free;
}

/// Completes a pane by what is around it. Returns false if chains cannot pass it.
bool look_around(const Flattened& flat, Pane& pane) {
  const double longest = std::max({pane.half[0], pane.half[1], pane.half[2]}), slack = contact * longest;
  if (std::min({pane.half[0], pane.half[1], pane.half[2]}) < 100 * slack) return false;
  for (std::size_t i = 0; i < flat.shapes.size(); ++i)
    if (i != pane.shape && !keeps_out(flat.shapes[i], pane, slack)) return false;
  return std::all_of(flat.volumes.begin(), flat.volumes.end(),
                     [&](const PlacedVolume& volume) { return is_even(volume, pane, slack); });
}

}  // namespace

std::vector<Pane> list_panes(const Flattened& flat, const Scene& scene) {
  std::vector<Pane> list;
  for (std::size_t i = 0; i < flat.shapes.size(); ++i) {
    const PlacedShape& shape = flat.shapes[i];
    const auto* glass = std::get_if<Dielectric<>>(&scene.materials[static_cast<std::size_t>(shape.material)].kind);
    const auto* box = std::get_if<Box<>>(&shape.shape);
    if (!glass || !box || glass->refractive_index < least_pane_index) continue;
    const Block block = box_block(shape.placement, *box);
    Pane pane;
    pane.shape = i, pane.middle = block.middle, pane.index = glass->refractive_index;
    for (std::size_t k = 0; k < 3; ++k) {
      pane.half[k] = length(block.edge[k]);
      pane.edge[k] = normalize(block.edge[k]);
    }
    if (look_around(flat, pane)) list.push_back(pane);
  }
  return list;
}

double worth_of(const Pane& pane, const Lights& lights, std::size_t k, Vec3d origin) {
  const Vec3d lamp = Vec3d{lights.center[0][k], lights.center[1][k], lights.center[2][k]} + origin;
  const double distance = distance_to(pane, lamp), reach = std::sqrt(static_cast<double>(lights.reach2[k]));
  if (reach > widest_lamp * distance) return 0;
  double area = 0;  // as seen from the lamp
  const Vec3d way = normalize(pane.middle - lamp);
  for (int i = 0; i < 3; ++i)
    area += 4 * std::abs(dot(pane.edge[i], way)) * pane.half[(i + 1) % 3] * pane.half[(i + 2) % 3];
  return static_cast<double>(lights.power[k]) * std::min(area / (distance * distance), 1.0);
}

void append_numbers(const Pane& p, Vec3d origin, std::vector<float>& numbers) {
  const auto add = [&](double value) { numbers.push_back(static_cast<float>(value)); };
  for (const Vec3d& edge : p.edge) add(edge.x), add(edge.y), add(edge.z);
  for (const Vec3d& edge : p.edge) add(-dot(edge, p.middle - origin));
  for (const double half : p.half) add(half);
  add(p.index), add(p.fog), add(p.closed);
}

}  // namespace tyndall
