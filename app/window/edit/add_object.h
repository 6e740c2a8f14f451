#pragma once
#include "app/window/edit/object_list.h"
#include "app/window/tools/projection.h"

#include <span>

/// New objects.
namespace tyndall {

/// What can be added.
enum class Addition { sphere, hollow_sphere, box, quad, light, medium };

struct AdditionEntry {
  Addition what;
  const char* name;  ///< "hollow ball"
  const char* help;
};
/// All there is to add, in the order of the menu.
std::span<const AdditionEntry> additions();

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

/// Adds an object at the end of the list, so that it stands on the spot, with a material of its kind: one that the
/// scene has under the usual name and with the usual values, else a new one. Returns the new objects, the largest
/// first.
ObjectPaths add_object(Scene& scene, Addition what, const Spot& spot);

}  // namespace tyndall
