#include "app/window/tools/selection.h"

#include "core/base/text.h"
#include "core/shapes/outline.h"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace tyndall {
namespace {

BoundingSphere own_bounding_sphere(const Sphere<>& sphere) {
  if (!sphere.center_end) return {sphere.center, std::abs(sphere.radius)};
  const Vec3d motion = *sphere.center_end - sphere.center;
  return {sphere.center + 0.5 * motion, std::abs(sphere.radius) + 0.5 * length(motion)};
}
BoundingSphere own_bounding_sphere(const Quad<>& quad) {
  return {quad.corner + 0.5 * (quad.u + quad.v), 0.5 * std::max(length(quad.u + quad.v), length(quad.u - quad.v))};
}
BoundingSphere own_bounding_sphere(const Triangle<>& triangle) { return own_bounding_sphere(frame_of(triangle)); }
BoundingSphere own_bounding_sphere(const Disk<>& disk) {
  return {disk.center, std::hypot(length(disk.u), length(disk.v))};
}
BoundingSphere own_bounding_sphere(const Box<>& box) {
  return {0.5 * (box.min + box.max), 0.5 * length(box.max - box.min)};
}

/// A sphere that holds both spheres.
BoundingSphere joined(const BoundingSphere& a, const BoundingSphere& b) {
  const double apart = length(b.center - a.center);
  if (apart + b.radius <= a.radius) return a;
  if (apart + a.radius <= b.radius) return b;
  const double radius = 0.5 * (apart + a.radius + b.radius);
  return {a.center + ((radius - a.radius) / apart) * (b.center - a.center), radius};
}

}  // namespace

const char* kind_name(const Object& object) {
  if (std::holds_alternative<Volume>(object.kind)) return "medium";
  if (std::holds_alternative<Group>(object.kind)) return "group";
  return std::visit([](const auto& shape) { return shape.type; }, std::get<Solid3d>(object.kind).shape);
}

const char* material_name(const Material& material) {
  return std::visit([](const auto& kind) { return kind.type; }, material.kind);
}

std::string title_of(const Scene& scene, const ObjectPath& path) {
  const Object* object = find_object(scene, path);
  if (!object) return "";
  std::string title = printable(object->name);
  if (title.empty()) title = std::string(kind_name(*object)) + " " + std::to_string(path.back() + 1);
  title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(title[0])));
  return title;
}

const Material* material_of(const Scene& scene, const Object& object) {
  const Solid3d* solid = std::get_if<Solid3d>(&object.kind);
  return solid ? &scene.materials[static_cast<std::size_t>(solid->material)] : nullptr;
}

int users_of(const Scene& scene, int material) {
  int users = 0;
  each_object(scene.objects, [&](const Object& object) {
    const Solid3d* solid = std::get_if<Solid3d>(&object.kind);
    users += solid && solid->material == material;
  });
  return users;
}

Placement placement_at(const Scene& scene, const ObjectPath& path) {
  Placement result;
  ObjectPath here;
  for (const int index : path) {
    here.push_back(index);
    const Object& object = *find_object(scene, here);
    result = compose(result, placement_of(object.transform));
    if (const Volume* volume = std::get_if<Volume>(&object.kind))
      result = compose(result, placement_of(volume->boundary_transform));
  }
  return result;
}

std::optional<BoundingSphere> bounding_sphere(const Scene& scene, const ObjectPath& path) {
  const Object* object = find_object(scene, path);
  if (!object) return {};
  std::optional<BoundingSphere> all;
  with_shape(*object, [&](const auto& shape) {
    all = own_bounding_sphere(shape);
    all->center = place(placement_at(scene, path), all->center);
  });
  const Group* group = std::get_if<Group>(&object->kind);
  if (!group) return all;
  ObjectPath child = path;
  child.push_back(0);
  const auto count = static_cast<int>(group->objects.size());
  for (; child.back() < count; ++child.back())
    if (const auto sphere = bounding_sphere(scene, child)) all = all ? joined(*all, *sphere) : *sphere;
  return all;
}

std::vector<ObjectPath> interesting(const Scene& scene) {
  const std::vector<ObjectPath> all = leaves(scene);
  const auto first = [&](const char* kind, std::vector<ObjectPath>& out) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const ObjectPath& path) {
      const Object& object = *find_object(scene, path);
      const Material* material = material_of(scene, object);
      return std::string(material ? material_name(*material) : kind_name(object)) == kind;
    });
    if (found != all.end()) out.push_back(*found);
  };
  std::vector<ObjectPath> out;
  for (const char* kind : {"metal", "dielectric", "medium"}) first(kind, out);
  if (out.empty())
    for (const char* kind : {"light", "lambertian"}) first(kind, out);
  return out;
}

}  // namespace tyndall
