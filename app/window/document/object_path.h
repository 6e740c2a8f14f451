#pragma once
#include "core/scene/scene.h"

#include <vector>

/// How the window names an object of a scene.
namespace tyndall {

/// Indices into Scene::objects and, for each further one, into the group's objects. Empty: nothing.
using ObjectPath = std::vector<int>;
using ObjectPaths = std::vector<ObjectPath>;

/// The object at a path; null for an empty path and for one that leads nowhere.
const Object* find_object(const Scene& scene, const ObjectPath& path);
Object* find_object(Scene& scene, const ObjectPath& path);

/// Where objects of a scene are in another state of it: those that are equal, else those of the same name, else those
/// that stand at the same place. Objects that are gone are left out.
ObjectPaths paths_after(const Scene& before, const Scene& after, const ObjectPaths& paths);

}  // namespace tyndall
