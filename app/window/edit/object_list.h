#pragma once
#include "app/window/tools/projection.h"

#include <span>
#include <string>
#include <vector>

/// Adding, duplicating, deleting and naming objects.
namespace tyndall {

/// The list that holds the object at a path.
std::vector<Object>& list_of(Scene& scene, const ObjectPath& path);

/// The paths in file order, each once, without those inside of a group that is itself among them.
ObjectPaths outermost(ObjectPaths paths);

/// Puts a copy of each object behind it in its list, and of the companions that go along with it. Copies of named
/// objects get a name of their own. Returns where the copies are.
ObjectPaths duplicate_objects(Scene& scene, const ObjectPaths& paths);

/// Takes objects and their companions out. Materials that nothing has any more go, too, unless `kept` names them: those
/// were written by a person. Returns how many objects went.
int delete_objects(Scene& scene, const ObjectPaths& paths, const std::vector<Material>& kept);

/// "ball", else "ball 2" and so on: the first that no object has. A number at the end of the wish counts on.
std::string free_name(const Scene& scene, const std::string& wish);

/// Where something is added: on a surface.
struct Spot {
  Vec3d point;            ///< in the world
  Vec3d normal{0, 1, 0};  ///< unit, the side from which it is seen
  double size = 1;        ///< > 0: what would look neither large nor small there, scene units
};

/// The side of the object's surface, at a point of it, that is turned to the eye. Upwards for what has no surface.
Vec3d normal_at(const Scene& scene, const ObjectPath& path, Vec3d point);

/// Where something is added: on the object (empty: none) that is seen at a point of the image, else as far away as what
/// the camera looks at. seen: the point of the object.
Spot spot_at(const Scene& scene, ImagePoint at, const ObjectPath& object, Vec3d seen);

/// Something that can be added.
struct Addition {
  const char* name;   ///< "a hollow ball"
  const char* words;  ///< other words for it, separated by ", "
  /// Adds it at the end of the list, so that it stands on the spot, with a material of its kind: one that the scene has
  /// under the usual name and with the usual values, else a new one. Returns the new objects, the largest first.
  ObjectPaths (*add)(Scene& scene, const Spot& spot);
};
/// All there is to add, in the order of the menu.
std::span<const Addition> additions();
/// The one of that name, which is there.
const Addition& addition_named(std::string_view name);

}  // namespace tyndall
