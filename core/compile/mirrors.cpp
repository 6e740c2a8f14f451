#include "core/compile/mirrors.h"

#include "core/compile/columns.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

constexpr double largest_light = 0.5;  // of a light's reach against its distance from the mirror

FlatMirror mirror_of(std::size_t shape, const Placement& placement, const BoxFace& face) {
  FlatMirror mirror;
  mirror.shape = shape;
  mirror.u = 0.5 * rotate(placement, face.u), mirror.v = 0.5 * rotate(placement, face.v);
  mirror.normal = normalize(rotate(placement, face.normal));
  mirror.middle = place(placement, face.corner) + mirror.u + mirror.v;
  return mirror;
}

/// Whether light from a light's image through the face may reach a quad on its front or back: the face has to reach in
/// between the image and the quad's plane.
bool approaches(const Vec3d (&corner)[4], Vec3d image, double reach, const Receiver& quad) {
  const Vec3d on_plane = quad.extent.points.front();
  const double start = dot(quad.normal, image - on_plane);
  if (std::abs(start) <= reach) return true;
  double low = 1e300, high = -1e300;
  for (const Vec3d& c : corner) {
    const double height = dot(quad.normal, c - on_plane) * (start > 0 ? 1 : -1);
    low = std::min(low, height), high = std::max(high, height);
  }
  return high > -reach && low < std::abs(start) + reach;
}

/// Whether light that seems to come from within `reach` of a light's image may reach a receiver: a part of the receiver
/// has to be on the light's side of the mirror, within the pyramid from the image through the face. May wrongly be
/// true, never wrongly false.
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
  return !receiver.is_quad || approaches(corner, image, reach, receiver);
}

}  // namespace

std::vector<FlatMirror> list_flat_mirrors(const Flattened& flat, const std::vector<Flat>& flats, const Scene& scene) {
  std::vector<FlatMirror> list;
  for (std::size_t i = 0; i < flat.shapes.size(); ++i) {
    const PlacedShape& shape = flat.shapes[i];
    if (!is_mirror(scene.materials[static_cast<std::size_t>(shape.material)].kind)) continue;
    if (const auto* quad = std::get_if<Quad<>>(&shape.shape))
      list.push_back(mirror_of(i, shape.placement, {cross(quad->u, quad->v), quad->corner, quad->u, quad->v}));
    const auto* box = std::get_if<Box<>>(&shape.shape);
    if (!box) continue;
    const Vec3d size = box->max - box->min;
    for (int face = 0; face < 6; ++face) {
      list.push_back(mirror_of(i, shape.placement, box_face_edges(*box, face)));
      list.back().face = face;
      list.back().depth = face < 2 ? size.x : face < 4 ? size.y : size.z;
    }
  }
  std::erase_if(list, [&](const FlatMirror& m) { return is_covered({m.middle, {m.u, m.v, {}}}, m.shape, flats); });
  return list;
}

std::vector<Receiver> list_receivers(const Flattened& flat, const Scene& scene) {
  std::vector<Receiver> list;
  for (const PlacedShape& shape : flat.shapes) {
    const Material& material = scene.materials[static_cast<std::size_t>(shape.material)];
    if (!traits_of(material.kind).diffuse) continue;
    Receiver receiver{extent_of(shape, scene.camera), false, {}};
    if (const auto* quad = std::get_if<Quad<>>(&shape.shape)) {
      receiver.is_quad = true;
      receiver.normal = normalize(rotate(shape.placement, cross(quad->u, quad->v)));
    }
    list.push_back(receiver);
  }
  for (const PlacedVolume& volume : flat.volumes) list.push_back({extent_of(volume, scene.camera), false, {}});
  return list;
}

double worth_of(const FlatMirror& m, const Lights& lights, std::size_t k, Vec3d origin,
                const std::vector<Receiver>& receivers) {
  const Vec3d light = Vec3d{lights.center[0][k], lights.center[1][k], lights.center[2][k]} + origin;
  const Vec3d to_light = light - m.middle;
  const double height = dot(to_light, m.normal), reach = std::sqrt(static_cast<double>(lights.reach2[k]));
  if (height == 0) return 0;
  if (m.depth > 0 && height < 0) {  // the inside of a box's face: for lights within the box
    const Reciprocal r = reciprocal_edges(m.u, m.v);
    if (-height > m.depth || std::abs(dot(r.a, to_light)) > 1 || std::abs(dot(r.b, to_light)) > 1) return 0;
  }
  const double distance = distance_to_flat(light, m.middle - m.u - m.v, 2.0 * m.u, 2.0 * m.v);
  if (reach > largest_light * distance) return 0;
  const Vec3d image = light - 2 * height * m.normal;
  if (std::none_of(receivers.begin(), receivers.end(),
                   [&](const Receiver& r) { return may_light(m, image, reach, r); }))
    return 0;
  const double fraction = length(cross(m.u, m.v)) * std::abs(height) / std::pow(distance, 3);
  return static_cast<double>(lights.power[k]) * std::min(fraction, 1.0);
}

void append_numbers(const FlatMirror& m, Vec3d origin, std::vector<float>& numbers) {
  const Reciprocal r = reciprocal_edges(m.u, m.v);
  const Vec3d middle = m.middle - origin, rows[] = {r.a, r.b, m.normal};
  const auto add = [&](double value) { numbers.push_back(static_cast<float>(value)); };
  for (const Vec3d& row : rows) add(row.x), add(row.y), add(row.z);
  for (const Vec3d& row : rows) add(-dot(row, middle));
  add(length(r.a)), add(length(r.b));
}

}  // namespace tyndall
