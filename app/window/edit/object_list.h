#pragma once
#include "app/window/tools/selection.h"

#include <string>
#include <vector>

/// Duplicating, deleting and naming objects.
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

}  // namespace tyndall
