#pragma once
#include "app/window/document/document.h"
#include "core/compile/flatten.h"

#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

/// What is selected in the window, and what is said of an object there.
namespace tyndall {

/// "sphere", "quad", "box", "triangle", "disk", "medium", "group".
const char* kind_name(const Object& object);
/// "lambertian", "metal", ...; a medium's or group's own kind.
const char* material_name(const Material& material);
/// The object's name with a capital, or its kind and number: "Ball", "Sphere 3".
std::string title_of(const Scene& scene, const ObjectPath& path);

/// The material of an object with a surface; null for others.
const Material* material_of(const Scene& scene, const Object& object);
/// How many objects (in groups too) have the material.
int users_of(const Scene& scene, int material);

/// Calls f with the shape of a solid or the boundary of a medium; groups have none.
template <class Item, class F>
void with_shape(Item& object, const F& f) {
  std::visit(
      [&]<class Kind>(Kind& kind) {
        if constexpr (std::is_same_v<std::remove_const_t<Kind>, Solid3d>)
          std::visit(f, kind.shape);
        else if constexpr (std::is_same_v<std::remove_const_t<Kind>, Volume>)
          std::visit(f, kind.boundary);
      },
      object.kind);
}
/// That shape, if it is of this type; else null.
template <class Shape, class Item>
auto shape_of(Item& object) {
  std::conditional_t<std::is_const_v<Item>, const Shape, Shape>* found = nullptr;
  with_shape(object, [&]<class Kind>(Kind& shape) {
    if constexpr (std::is_same_v<std::remove_const_t<Kind>, Shape>) found = &shape;
  });
  return found;
}

/// Where the object's own frame is in the world (a medium: its boundary's).
Placement placement_at(const Scene& scene, const ObjectPath& path);

/// A sphere around an object; nothing for an empty group.
struct BoundingSphere {
  Vec3d center;
  double radius = 0;
};
std::optional<BoundingSphere> bounding_sphere(const Scene& scene, const ObjectPath& path);

/// What a new user should touch first: the first object of fuzzy or plain metal, of glass and of media; without them
/// the first light and the first matt object.
std::vector<ObjectPath> interesting(const Scene& scene);

}  // namespace tyndall
