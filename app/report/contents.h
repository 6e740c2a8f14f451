#pragma once
#include "core/scene/scene.h"

#include <map>
#include <string>
#include <variant>
#include <vector>

/// This room finds out what both the window and the commands tell about scenes, pictures and kernels.
namespace tyndall {

/// Indices into Scene::objects and, for each further one, into the group's objects. Empty: nothing.
using ObjectPath = std::vector<int>;

/// The object at a path; null for an empty path and for one that leads nowhere.
const Object* find_object(const Scene& scene, const ObjectPath& path);

/// Every object that is no group, in file order.
std::vector<ObjectPath> leaves(const Scene& scene);

/// Calls f with each object of a list, groups and what is in them, too.
template <class Objects, class F>
void each_object(Objects& objects, const F& f) {
  for (auto& object : objects) {
    f(object);
    if (auto* group = std::get_if<Group>(&object.kind)) each_object(group->objects, f);
  }
}

/// What a scene contains, counted through all groups.
struct Contents {
  std::map<std::string, int> shapes;     ///< by type; moving spheres as "moving sphere"
  std::map<std::string, int> materials;  ///< by type
  std::map<std::string, int> textures;   ///< by type
  std::vector<std::string> with_alpha;   ///< names of the textures whose pictures have an alpha channel
  int media = 0, phase_functions = 0;    ///< phase_functions: media with g != 0
  int lights = 0;                        ///< emitting primitives; a box has six
  bool motion = false;                   ///< something moves while the shutter is open
  bool defocus = false;
  std::string background;  ///< "constant", "gradient", "hemispheres", "image"; "none" if it is black
};

Contents contents_of(const Scene& scene);

/// One sentence about the textures that have an alpha channel: it is not looked at. "": none has.
std::string alpha_note(std::vector<std::string> with_alpha);

}  // namespace tyndall
