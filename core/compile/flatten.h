#pragma once
#include "core/compile/render_scene.h"
#include "core/scene/scene.h"

#include <optional>
#include <variant>
#include <vector>

/// The first half of compiling: resolves groups and transforms, in double and in world space, and finds the models that
/// the scene contains.
namespace tyndall {

/// A rotation about the y axis by `degrees`, then a translation.
struct Placement {
  double degrees = 0;
  Vec3d offset;
  bool operator==(const Placement&) const = default;
};

/// Returns the placement that applies `inner` first, then `outer`.
Placement compose(const Placement& outer, const Placement& inner);
Placement placement_of(const Transform& list);
Vec3d rotate(const Placement& p, Vec3d v);  ///< a direction
Vec3d place(const Placement& p, Vec3d v);   ///< a point

struct PlacedShape {
  std::variant<Sphere<>, Quad<>, Box<>, Triangle<>, Disk<>> shape;  ///< in its own frame
  Placement placement;
  int material = -1;
  std::int32_t object = -1;  ///< number in Flattened::objects
};

struct PlacedVolume {
  std::variant<Sphere<>, Box<>> boundary;
  Placement placement;
  Medium<> medium;
  ColourOrTexture albedo;
  std::optional<int> surface;  ///< the shape that equals the boundary exactly, if any: the medium is its interior
};

struct Flattened {
  std::vector<PlacedShape> shapes;    ///< without exact copies of earlier ones
  std::vector<PlacedVolume> volumes;  ///< of density > 0
  ObjectTree objects;                 ///< of the whole scene
};

Flattened flatten(const Scene& scene);

/// The first element of each shape, and one behind the last: a box has six, all others have one.
std::vector<std::int32_t> first_elements(const Flattened& flat);

/// A point in the middle of a shape, world space.
Vec3d center_of(const PlacedShape& shape);
Vec3d center_of(const PlacedVolume& volume);

/// The space that a shape fills while the shutter is open: the convex hull of these points (world space), grown by
/// `radius` on all sides.
struct Extent {
  std::vector<Vec3d> points;
  double radius = 0;
};
Extent extent_of(const PlacedShape& shape, const Camera& camera);
Extent extent_of(const PlacedVolume& volume, const Camera& camera);

/// Returns the features of a scene. flat: the scene, flattened. Materials and textures count only where something in
/// the picture uses them.
SceneFeatures features_of(const Scene& scene, const Flattened& flat);

}  // namespace tyndall
