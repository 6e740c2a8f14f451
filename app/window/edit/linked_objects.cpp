
#include "app/window/edit/arrange.h"

#include <cmath>

namespace tyndall {
namespace {

/// Whether the object is a smaller sphere around the centre of a sphere of glass.
bool is_inner_sphere(const Scene& scene, const Object& object, const Object& leader) {
  const Sphere<>*inner = shape_of<Sphere<>>(object), *outer = shape_of<Sphere<>>(leader);
  const Material* material = material_of(scene, leader);
  const bool glass = material && std::holds_alternative<Dielectric<>>(material->kind);
  return glass && inner && outer && inner->center == outer->center && inner->center_end == outer->center_end &&
         std::abs(inner->radius) < std::abs(outer->radius);
}

/// leader: a solid.
bool belongs_to(const Scene& scene, const Object& object, const Object& leader) {
  const Volume* volume = std::get_if<Volume>(&object.kind);
  return (volume && fills(*volume, std::get<Solid3d>(leader.kind))) || is_inner_sphere(scene, object, leader);
}

/// Gives the companion the changes between two states of its sphere. linked: as it was before.
void follow(const Object& leader_before, const Object& leader, const Object& linked, Object& result) {
  const Solid3d &solid_before = std::get<Solid3d>(leader_before.kind), &solid = std::get<Solid3d>(leader.kind);
  Volume* volume = std::get_if<Volume>(&result.kind);
  if (volume && fills(std::get<Volume>(linked.kind), solid_before)) {
    std::visit(
        [&]<class Shape>(const Shape& shape) {
          if constexpr (std::is_constructible_v<decltype(volume->boundary), Shape>) volume->boundary = shape;
        },
        solid.shape);
  } else if (const Sphere<>* outer = std::get_if<Sphere<>>(&solid.shape)) {
    const Sphere<>&before = std::get<Sphere<>>(solid_before.shape), &inner = *shape_of<Sphere<>>(linked);
    Sphere<>& sphere = *shape_of<Sphere<>>(result);
    sphere.center = outer->center;
    if (!volume) sphere.center_end = outer->center_end;
    const double ratio = std::abs(outer->radius / before.radius);
    sphere.radius =
        ratio == 1 ? inner.radius
                   : rounded(inner.radius * ratio, {1, decimal_below(std::abs(inner.radius * ratio)).exponent - 5});
  }
  if (own_transform(linked) == own_transform(leader_before)) own_transform(result) = own_transform(leader);
}

}  // namespace

bool fills(const Volume& volume, const Solid3d& solid) {
  return std::visit(
      [&]<class Shape>(const Shape& boundary) {
        const Shape* shape = std::get_if<Shape>(&solid.shape);
        return shape && *shape == boundary;
      },
      volume.boundary);
}

std::vector<ObjectPath> linked_objects(const Scene& scene, const ObjectPath& path) {
  const Object* leader = find_object(scene, path);
  std::vector<ObjectPath> found;
  if (!leader || !std::holds_alternative<Solid3d>(leader->kind)) return found;
  const Placement placed = placement_at(scene, path);
  for (const ObjectPath& other : leaves(scene))
    if (other != path && belongs_to(scene, *find_object(scene, other), *leader) && placement_at(scene, other) == placed)
      found.push_back(other);
  return found;
}

void move_linked_objects(const Scene& start, const Scene& last, Scene& next) {
  if (last.objects == next.objects) return;
  const std::vector<ObjectPath> paths = leaves(start);
  if (paths != leaves(next) || paths != leaves(last)) return;
  for (const ObjectPath& path : paths) {
    const Object &was = *find_object(start, path), leader = *find_object(next, path);
    const Solid3d *before = std::get_if<Solid3d>(&was.kind), *now = std::get_if<Solid3d>(&leader.kind);
    if (!before || !now || leader == *find_object(last, path) || before->shape.index() != now->shape.index()) continue;
    for (const ObjectPath& other : linked_objects(start, path))
      follow(was, leader, *find_object(start, other), *find_object(next, other));
  }
}

}  // namespace tyndall
