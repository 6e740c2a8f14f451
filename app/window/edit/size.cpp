#include "app/window/edit/size.h"

#include "core/base/math.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

using Grips = std::vector<SizeGrip>;

Grips grips_of(const Sphere<>& sphere, const Placement& at, Vec3d across) {
  const double radius = std::abs(sphere.radius);
  return {{place(at, sphere.center) + radius * across, across, radius, "radius"}};
}

Grips grips_of(const Quad<>& quad, const Placement& at, Vec3d /*across*/) {
  return {{place(at, quad.corner + quad.u + 0.5 * quad.v), normalize(rotate(at, quad.u)), length(quad.u), "u"},
          {place(at, quad.corner + quad.v + 0.5 * quad.u), normalize(rotate(at, quad.v)), length(quad.v), "v"}};
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

void set_value(Quad<>& quad, std::size_t grip, double value, double minimum) {
  Vec3d& edge = grip == 0 ? quad.u : quad.v;
  edge = without_noise((std::max(value, minimum) / length(edge)) * edge);
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
