#include "app/window/edit/arrange.h"

#include "core/base/kinds.h"
#include "core/base/math.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

template <class Shape>
auto& place_of(Shape& shape) {
  if constexpr (requires { shape.center; })
    return shape.center;
  else if constexpr (requires { shape.corner; })
    return shape.corner;
  else
    return shape.min;
}

template <class Shape>
void set_place(Shape& shape, Vec3d place) {
  const Vec3d by = place - place_of(shape);
  if constexpr (requires { shape.center_end; })
    if (shape.center_end) shape.center_end = without_noise(*shape.center_end + by);
  if constexpr (requires { shape.max; }) shape.max = without_noise(shape.max + by);
  place_of(shape) = place;
}

/// The middle of an object in the frame that own_transform() places.
Vec3d own_middle(const Object& object) {
  if (const Triangle<>* triangle = shape_of<Triangle<>>(object))
    return triangle->corner + (1.0 / 3) * (triangle->u + triangle->v);
  Scene alone;
  alone.objects.push_back(object);
  own_transform(alone.objects[0]).clear();
  const auto sphere = bounding_sphere(alone, {0});
  return sphere ? sphere->center : Vec3d{};
}

double within_180_degrees(double degrees) {
  const double revolutions = std::round(degrees / 360);
  return without_noise(degrees - 360 * revolutions);
}

using Grips = std::vector<SizeGrip>;

Grips grips_of(const Sphere<>& sphere, const Placement& at, Vec3d across) {
  const double radius = std::abs(sphere.radius);
  return {{place(at, sphere.center) + radius * across, across, radius, "radius"}};
}

/// At the end of an edge, or of a half axis, that begins at `foot`.
SizeGrip grip_of(const Placement& at, Vec3d foot, Vec3d edge, const char* name) {
  return {place(at, foot + edge), normalize(rotate(at, edge)), length(edge), name};
}

Grips grips_of(const Quad<>& quad, const Placement& at, Vec3d /*across*/) {
  return {grip_of(at, quad.corner + 0.5 * quad.v, quad.u, "u"), grip_of(at, quad.corner + 0.5 * quad.u, quad.v, "v")};
}

Grips grips_of(const Triangle<>& triangle, const Placement& at, Vec3d /*across*/) {
  return {grip_of(at, triangle.corner, triangle.u, "u"), grip_of(at, triangle.corner, triangle.v, "v")};
}

/// The half axes, and the hole of a ring.
Grips grips_of(const Disk<>& disk, const Placement& at, Vec3d /*across*/) {
  Grips grips{grip_of(at, disk.center, disk.u, "u"), grip_of(at, disk.center, disk.v, "v")};
  if (disk.inner > 0) grips.push_back(grip_of(at, disk.center, -disk.inner * disk.u, "inner"));
  return grips;
}

Grips grips_of(const Box<>& box, const Placement& at, Vec3d /*across*/) {
  static constexpr const char* names[6] = {"x", "-x", "y", "-y", "z", "-z"};
  const Vec3d middle = 0.5 * (box.min + box.max);
  const Vec3d axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  Grips grips;
  for (int face = 0; face < 6; ++face) {
    const Vec3d axis = axes[face / 2];
    const double value = face % 2 == 0 ? dot(box.max, axis) : -dot(box.min, axis);
    const Vec3d pull = face % 2 == 0 ? axis : -1.0 * axis;
    grips.push_back({place(at, middle + (value - dot(middle, pull)) * pull), rotate(at, pull), value, names[face]});
  }
  return grips;
}

void set_value(Sphere<>& sphere, std::size_t /*grip*/, double value, double minimum) {
  sphere.radius = std::copysign(std::max(value, minimum), sphere.radius);
}

/// Of a quad, a triangle or a disk: an edge or half axis, or the hole of a ring.
template <class Flat>
void set_value(Flat& flat, std::size_t grip, double value, double minimum) {
  constexpr double narrowest = 0.99;  // of the rim's radius, to which the hole can be pulled
  Vec3d& edge = grip == 1 ? flat.v : flat.u;
  const double part = std::max(value, minimum) / length(edge);
  if (grip < 2) edge = without_noise(part * edge);
  if constexpr (requires { flat.inner; })
    if (grip == 2) flat.inner = without_noise(std::min(part, narrowest));
}

void set_value(Box<>& box, std::size_t grip, double value, double minimum) {
  double* const low[3] = {&box.min.x, &box.min.y, &box.min.z};
  double* const high[3] = {&box.max.x, &box.max.y, &box.max.z};
  double &from = *low[grip / 2], &to = *high[grip / 2];
  if (grip % 2 == 0)
    to = value - from >= minimum ? value : without_noise(from + minimum);
  else
    from = to + value >= minimum ? -value + 0.0 : without_noise(to - minimum);
}

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

Grips size_grips(const Scene& scene, const ObjectPath& path, Vec3d across) {
  const Object* object = find_object(scene, path);
  if (!object) return {};
  Grips grips;
  with_shape(*object, [&](const auto& shape) { grips = grips_of(shape, placement_at(scene, path), across); });
  return grips;
}

void set_size(Scene& scene, const ObjectPath& path, std::size_t grip, double value, double minimum) {
  with_shape(*find_object(scene, path), [&](auto& shape) { set_value(shape, grip, value, minimum); });
}

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
