#pragma once
#include "core/scene/scene.h"

#include <optional>
#include <variant>
#include <vector>

/// The first half of compiling: groups and transforms are resolved, in double, in world space.
namespace tyndall {

/// A rotation about the y axis by `degrees`, then a translation.
struct Placement {
  double degrees = 0;
  Vec3d offset;
  bool operator==(const Placement&) const = default;
};

/// `outer` after `inner`.
Placement compose(const Placement& outer, const Placement& inner);
Placement placement_of(const Transform& list);
Vec3d turn(const Placement& p, Vec3d v);   ///< a direction
Vec3d place(const Placement& p, Vec3d v);  ///< a point

struct PlacedShape {
  std::variant<Sphere<>, Quad<>, Box<>> shape;  ///< in its own frame
  Placement placement;
  int material = -1;
  std::vector<int> object;  ///< path of indices into Scene::objects
};

struct PlacedVolume {
  std::variant<Sphere<>, Box<>> boundary;
  Placement placement;
  Medium<> medium;
  ColourOrTexture albedo;
  std::optional<int> surface;  ///< the placed shape that the boundary equals exactly: the medium is its interior
};

struct Flattened {
  std::vector<PlacedShape> shapes;    ///< without exact copies of earlier ones
  std::vector<PlacedVolume> volumes;  ///< of density > 0
};

Flattened flatten(const Scene& scene);

/// A point in the middle of a shape, world space.
Vec3d center_of(const PlacedShape& shape);
Vec3d center_of(const PlacedVolume& volume);

/// What holds a shape over the whole shutter: the hull of these points, world space, grown by `radius`.
struct Extent {
  std::vector<Vec3d> points;
  double radius = 0;
};
Extent extent_of(const PlacedShape& shape, const Camera& camera);
Extent extent_of(const PlacedVolume& volume, const Camera& camera);

}  // namespace tyndall
