#include "app/window/edit/arrange.h"

#include "core/base/kinds.h"

#include <cmath>

namespace tyndall {
namespace {

Vec3d place_of(const Sphere<>& sphere) { return sphere.center; }
Vec3d place_of(const Quad<>& quad) { return quad.corner; }
Vec3d place_of(const Box<>& box) { return box.min; }

void set_place(Sphere<>& sphere, Vec3d place) {
  if (sphere.center_end) sphere.center_end = without_noise(*sphere.center_end + (place - sphere.center));
  sphere.center = place;
}
void set_place(Quad<>& quad, Vec3d place) { quad.corner = place; }
void set_place(Box<>& box, Vec3d place) {
  box.max = without_noise(box.max + (place - box.min));
  box.min = place;
}

Vec3d middle(const Sphere<>& sphere) {
  return sphere.center_end ? 0.5 * (sphere.center + *sphere.center_end) : sphere.center;
}
Vec3d middle(const Quad<>& quad) { return quad.corner + 0.5 * (quad.u + quad.v); }
Vec3d middle(const Box<>& box) { return 0.5 * (box.min + box.max); }

/// The middle of an object in the frame that own_transform() places.
Vec3d own_middle(const Object& object) {
  Vec3d result;
  if (std::holds_alternative<Group>(object.kind)) {
    Object free = object;
    free.transform.clear();
    Scene alone;
    alone.objects.push_back(std::move(free));
    const auto sphere = bounding_sphere(alone, {0});
    return sphere ? sphere->center : result;
  }
  with_shape(object, [&](const auto& shape) { result = middle(shape); });
  const Volume* volume = std::get_if<Volume>(&object.kind);
  const bool inner = volume && &own_transform(object) != &volume->boundary_transform;
  return inner ? place(placement_of(volume->boundary_transform), result) : result;
}

double within_180_degrees(double degrees) {
  const double revolutions = std::round(degrees / 360);
  return without_noise(degrees - 360 * revolutions);
}

}  // namespace

Transform& own_transform(Object& object) {
  Volume* volume = std::get_if<Volume>(&object.kind);
  return volume && object.transform.empty() ? volume->boundary_transform : object.transform;
}

const Transform& own_transform(const Object& object) { return own_transform(const_cast<Object&>(object)); }

Placement outer_placement(const Scene& scene, const ObjectPath& path) {
  return placement_at(scene, ObjectPath(path.begin(), path.end() - (path.empty() ? 0 : 1)));
}

Vec3d anchor_of(const Scene& scene, const ObjectPath& path) {
  const Object& object = *find_object(scene, path);
  const Transform& transform = own_transform(object);
  if (!transform.empty()) {
    const Translate* last = std::get_if<Translate>(&transform.back());
    return last ? last->offset : Vec3d{};
  }
  Vec3d result;
  with_shape(object, [&](const auto& shape) { result = place_of(shape); });
  return result;
}

void set_anchor(Scene& scene, const ObjectPath& path, Vec3d anchor) {
  Object& object = *find_object(scene, path);
  Transform& transform = own_transform(object);
  if (transform.empty() && !std::holds_alternative<Group>(object.kind))
    return with_shape(object, [&](auto& shape) { set_place(shape, anchor); });
  if (transform.empty() || !std::holds_alternative<Translate>(transform.back())) transform.push_back(Translate{});
  std::get<Translate>(transform.back()).offset = anchor;
}

void rotate_object(Scene& scene, const ObjectPath& path, double degrees) {
  Object& object = *find_object(scene, path);
  Transform& transform = own_transform(object);
  const Placement before = placement_of(transform);
  const Vec3d center = place(before, own_middle(object));
  if (transform.empty()) {
    const Vec3d at = without_noise(Vec3d{center.x, 0, center.z});
    with_shape(object, [&](auto& shape) { set_place(shape, without_noise(place_of(shape) - at)); });
  }
  const Placement rotated{within_180_degrees(before.degrees + degrees), {}};
  const Vec3d offset = without_noise(rounded(center - rotate(rotated, own_middle(object)),
                                             {1, decimal_below(std::abs(length(center)) + 1).exponent - 6}));
  transform.clear();
  if (rotated.degrees != 0) transform.push_back(RotateY{rotated.degrees});
  if (!(offset == Vec3d{}) || transform.empty()) transform.push_back(Translate{offset});
}

double angle_of(const Scene& scene, const ObjectPath& path) {
  return within_180_degrees(placement_of(own_transform(*find_object(scene, path))).degrees);
}

Vec3d middle_of(const Scene& scene, const ObjectPath& path) {
  const Object& object = *find_object(scene, path);
  return place(compose(outer_placement(scene, path), placement_of(own_transform(object))), own_middle(object));
}

}  // namespace tyndall
