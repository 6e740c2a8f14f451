#include "core/compile/flat_objects.h"

#include "core/compile/columns.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

constexpr double largest_light = 0.5;  // of a light's reach against its distance from the mirror or slab

FlatRecord record_of(const Vec3d (&rows)[3], Vec3d middle, const double (&size)[3]) {
  FlatRecord record{};
  for (int k = 0; k < 3; ++k) {
    record.row[k] = to_float(rows[k]), record.offset[k] = static_cast<float>(-dot(rows[k], middle));
    record.size[k] = static_cast<float>(size[k]);
  }
  return record;
}

/// Whether light from a light's image through the face may reach a quad on its front or back: the face has to reach in
/// between the image and the quad's plane.
bool approaches(const Vec3d (&corner)[4], Vec3d image, double reach, Vec3d normal, Vec3d on_plane) {
  const double start = dot(normal, image - on_plane);
  if (std::abs(start) <= reach) return true;
  double low = 1e300, high = -1e300;
  for (const Vec3d& c : corner) {
    const double height = dot(normal, c - on_plane) * (start > 0 ? 1 : -1);
    low = std::min(low, height), high = std::max(high, height);
  }
  return high > -reach && low < std::abs(start) + reach;
}

/// Whether light that seems to come from within `reach` of a light's image may reach a receiver: a part of the receiver
/// has to be on the light's side of the mirror, within the pyramid from the image through the face.
bool may_light(const FlatMirror& m, Vec3d image, double reach, const Receiver& receiver) {
  const std::vector<Vec3d>& points = receiver.extent.points;
  const double height = dot(image - m.middle, m.normal);
  const Vec3d corner[] = {m.middle - m.u - m.v, m.middle + m.u - m.v, m.middle + m.u + m.v, m.middle - m.u + m.v};
  const auto reaches = [&](Vec3d inward, Vec3d from) {
    return std::any_of(points.begin(), points.end(), [&](Vec3d p) {
      const double room = receiver.extent.radius + reach * (1 + 2 * length(p - image) / std::abs(height));
      return dot(inward, p - from) > -room;
    });
  };
  if (!reaches(height > 0 ? -m.normal : m.normal, m.middle)) return false;
  for (int i = 0; i < 4; ++i) {
    const Vec3d side = normalize(cross(corner[i] - image, corner[(i + 1) % 4] - image));
    if (!reaches(dot(side, m.middle - image) > 0 ? side : -side, image)) return false;
  }
  return !receiver.normal || approaches(corner, image, reach, *receiver.normal, points.front());
}

constexpr double contact = 1e-6;  // of the longest half edge: by so much things may overlap without counting

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

/// Whether no flat reaches into the slab. Marks the faces that a flat touches as closed.
bool flats_keep_out(const std::vector<Flat>& flats, Slab& slab, double slack) {
  const double radius = length(Vec3d{slab.half[0], slab.half[1], slab.half[2]}) + slack;
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
  const auto reaches_in = [&](const PlacedShape& shape) {
    const auto* sphere = std::get_if<Sphere<>>(&shape.shape);
    return sphere && crosses(slab, round_body(*sphere, shape.placement), slack);
  };
  if (std::any_of(flat.shapes.begin(), flat.shapes.end(), reaches_in)) return false;
  if (!flats_keep_out(flats, slab, slack)) return false;
  return std::all_of(flat.volumes.begin(), flat.volumes.end(),
                     [&](const PlacedVolume& volume) { return is_even(volume, slab, slack); });
}

}  // namespace

std::vector<FlatMirror> list_flat_mirrors(const Flattened& flat, const std::vector<Flat>& flats, const Scene& scene) {
  std::vector<FlatMirror> list;
  int face = 0;
  for (std::size_t i = 0; i < flats.size(); ++i) {
    const auto& [number, block, radius] = flats[i];
    face = i > 0 && flats[i - 1].shape == number ? face + 1 : 0;
    const PlacedShape& shape = flat.shapes[number];
    const auto* box = std::get_if<Box<>>(&shape.shape);
    if (!box && !std::holds_alternative<Quad<>>(shape.shape)) continue;
    if (!is_mirror(scene.materials[static_cast<std::size_t>(shape.material)].kind)) continue;
    if (is_covered(block, number, flats)) continue;
    const Vec3d u = block.edge[0], v = block.edge[1], size = box ? box->max - box->min : Vec3d{};
    const double depth[] = {size.x, size.y, size.z};
    list.push_back({number, face, block.middle, u, v, normalize(cross(u, v)), depth[face / 2]});
  }
  return list;
}

std::vector<Receiver> list_receivers(const Flattened& flat, const Scene& scene) {
  std::vector<Receiver> list;
  for (const PlacedShape& shape : flat.shapes) {
    const Material& material = scene.materials[static_cast<std::size_t>(shape.material)];
    if (!traits_of(material.kind).diffuse) continue;
    list.push_back({extent_of(shape, scene.camera), {}});
    if (const std::optional<Quad<>> quad = frame_of_flat(shape))
      list.back().normal = normalize(rotate(shape.placement, cross(quad->u, quad->v)));
  }
  for (const PlacedVolume& volume : flat.volumes) list.push_back({extent_of(volume, scene.camera), {}});
  return list;
}

LightBounds light_bounds(const RenderScene& scene, std::size_t k) {
  const Lights& lights = scene.lights;
  return {to_double(lights.center[k]) + scene.origin, std::sqrt(static_cast<double>(lights.reach2[k])),
          static_cast<double>(lights.power[k])};
}

double worth_of(const FlatMirror& m, const LightBounds& light) {
  const Vec3d to_light = light.center - m.middle;
  const double height = dot(to_light, m.normal);
  if (height == 0) return 0;
  if (m.depth > 0 && height < 0) {  // the inside of a box's face: for lights within the box
    const Reciprocal r = reciprocal_edges(m.u, m.v);
    if (-height > m.depth || std::abs(dot(r.a, to_light)) > 1 || std::abs(dot(r.b, to_light)) > 1) return 0;
  }
  const double distance = distance_to_flat(light.center, m.middle - m.u - m.v, 2.0 * m.u, 2.0 * m.v);
  if (light.reach > largest_light * distance) return 0;
  const double fraction = length(cross(m.u, m.v)) * std::abs(height) / (distance * distance * distance);
  return light.power * std::min(fraction, 1.0);
}

bool may_light(const FlatMirror& m, const LightBounds& light, const std::vector<Receiver>& receivers) {
  const Vec3d image = light.center - 2 * dot(light.center - m.middle, m.normal) * m.normal;
  return std::any_of(receivers.begin(), receivers.end(),
                     [&](const Receiver& receiver) { return may_light(m, image, light.reach, receiver); });
}

FlatRecord record_of(const FlatMirror& m, Vec3d origin) {
  const Reciprocal r = reciprocal_edges(m.u, m.v);
  return record_of({r.a, r.b, m.normal}, m.middle - origin, {length(r.a), length(r.b), 0});
}

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

double worth_of(const Slab& slab, const LightBounds& light) {
  const double distance = distance_to(slab, light.center);
  if (light.reach > largest_light * distance) return 0;
  double area = 0;  // as seen from the light
  const Vec3d to_light = normalize(slab.middle - light.center);
  for (int i = 0; i < 3; ++i)
    area += 4 * std::abs(dot(slab.edge[i], to_light)) * slab.half[(i + 1) % 3] * slab.half[(i + 2) % 3];
  return light.power * std::min(area / (distance * distance), 1.0);
}

FlatRecord record_of(const Slab& p, Vec3d origin) {
  FlatRecord record = record_of(p.edge, p.middle - origin, p.half);
  record.index = static_cast<float>(p.index), record.medium_density = static_cast<float>(p.medium_density);
  record.closed = p.closed;
  return record;
}

}  // namespace tyndall
