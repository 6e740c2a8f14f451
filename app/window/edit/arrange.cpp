#include "app/window/edit/arrange.h"

#include "core/base/kinds.h"
#include "core/base/math.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

constexpr int min_exponent = -300, max_exponent = 300;  // where powers of ten are numbers

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

Vec3d middle(const Sphere<>& sphere) {
  return sphere.center_end ? 0.5 * (sphere.center + *sphere.center_end) : sphere.center;
}
Vec3d middle(const Quad<>& quad) { return quad.corner + 0.5 * (quad.u + quad.v); }
Vec3d middle(const Box<>& box) { return 0.5 * (box.min + box.max); }
Vec3d middle(const Triangle<>& triangle) { return triangle.corner + (1.0 / 3) * (triangle.u + triangle.v); }
Vec3d middle(const Disk<>& disk) { return disk.center; }

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

using Grips = std::vector<SizeGrip>;

Grips grips_of(const Sphere<>& sphere, const Placement& at, Vec3d across) {
  const double radius = std::abs(sphere.radius);
  return {{place(at, sphere.center) + radius * across, across, radius, "radius"}};
}

Grips grips_of(const Quad<>& quad, const Placement& at, Vec3d /*across*/) {
  return {{place(at, quad.corner + quad.u + 0.5 * quad.v), normalize(rotate(at, quad.u)), length(quad.u), "u"},
          {place(at, quad.corner + quad.v + 0.5 * quad.u), normalize(rotate(at, quad.v)), length(quad.v), "v"}};
}

Grips grips_of(const Triangle<>& triangle, const Placement& at, Vec3d /*across*/) {
  const auto grip = [&](Vec3d edge, const char* name) {
    return SizeGrip{place(at, triangle.corner + edge), normalize(rotate(at, edge)), length(edge), name};
  };
  return {grip(triangle.u, "u"), grip(triangle.v, "v")};
}

/// The half axes, and the hole of a ring.
Grips grips_of(const Disk<>& disk, const Placement& at, Vec3d /*across*/) {
  const auto grip = [&](Vec3d arm, const char* name) {
    return SizeGrip{place(at, disk.center + arm), normalize(rotate(at, arm)), length(arm), name};
  };
  Grips grips{grip(disk.u, "u"), grip(disk.v, "v")};
  if (disk.inner > 0) grips.push_back(grip(-disk.inner * disk.u, "inner"));
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

void set_edge(Vec3d& edge, double value, double minimum) {
  edge = without_noise((std::max(value, minimum) / length(edge)) * edge);
}
void set_value(Quad<>& quad, std::size_t grip, double value, double minimum) {
  set_edge(grip == 0 ? quad.u : quad.v, value, minimum);
}
void set_value(Triangle<>& triangle, std::size_t grip, double value, double minimum) {
  set_edge(grip == 0 ? triangle.u : triangle.v, value, minimum);
}
void set_value(Disk<>& disk, std::size_t grip, double value, double minimum) {
  constexpr double narrowest = 0.99;  // of the rim's radius, to which the hole can be pulled
  if (grip < 2)
    set_edge(grip == 0 ? disk.u : disk.v, value, minimum);
  else
    disk.inner = without_noise(std::min(std::max(value, minimum) / length(disk.u), narrowest));
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

}  // namespace

double DragRounding::size() const { return multiple * std::pow(10.0, exponent); }

DragRounding decimal_below(double size) {
  const double exponent = std::floor(std::log10(size) + 1e-9);
  return {1, static_cast<int>(std::fmin(std::fmax(exponent, min_exponent), max_exponent))};
}

DragRounding nice_below(double size) {
  DragRounding drag_rounding = decimal_below(size);
  for (const int multiple : {2, 5})
    if (multiple * std::pow(10.0, drag_rounding.exponent) <= size * (1 + 1e-9)) drag_rounding.multiple = multiple;
  return drag_rounding;
}

double rounded(double value, DragRounding drag_rounding) {
  // Grains below 1 divide by a power of ten, which is exact: the result prints short.
  if (drag_rounding.exponent < 0) {
    const double per_unit = std::pow(10.0, -drag_rounding.exponent);
    return std::round(value * per_unit / drag_rounding.multiple) * drag_rounding.multiple / per_unit + 0.0;
  }
  return std::round(value / drag_rounding.size()) * drag_rounding.size() + 0.0;
}

Vec3d rounded(Vec3d v, DragRounding drag_rounding) {
  return {rounded(v.x, drag_rounding), rounded(v.y, drag_rounding), rounded(v.z, drag_rounding)};
}

double without_noise(double value) {
  if (value == 0 || !std::isfinite(value)) return value;
  return rounded(value, {1, decimal_below(std::abs(value)).exponent - 11});
}

Vec3d without_noise(Vec3d v) { return {without_noise(v.x), without_noise(v.y), without_noise(v.z)}; }

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

}  // namespace tyndall
