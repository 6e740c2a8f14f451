#include "app/window/edit/object_list.h"

#include "app/window/edit/linked_objects.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <utility>

namespace tyndall {
namespace {

bool starts_with(const ObjectPath& path, const ObjectPath& start) {
  return path.size() >= start.size() && std::equal(start.begin(), start.end(), path.begin());
}

ObjectPaths with_linked_objects(const Scene& scene, const ObjectPaths& paths) {
  ObjectPaths all = paths;
  for (const ObjectPath& path : paths)
    for (const ObjectPath& other : linked_objects(scene, path)) all.push_back(other);
  return outermost(std::move(all));
}

void collect_names(const std::vector<Object>& objects, std::set<std::string>& names) {
  for (const Object& object : objects) {
    names.insert(object.name);
    if (const Group* group = std::get_if<Group>(&object.kind)) collect_names(group->objects, names);
  }
}

/// Calls f with the index of each material that is used.
template <class F>
void each_material(std::vector<Object>& objects, const F& f) {
  for (Object& object : objects) {
    if (Solid3d* solid = std::get_if<Solid3d>(&object.kind)) f(solid->material);
    if (Group* group = std::get_if<Group>(&object.kind)) each_material(group->objects, f);
  }
}

void delete_unused_materials(Scene& scene, const std::vector<Material>& kept) {
  std::set<int> used;
  each_material(scene.objects, [&](int material) { used.insert(material); });
  for (int k = static_cast<int>(scene.materials.size()) - 1; k >= 0; --k) {
    const std::string& name = scene.materials[static_cast<std::size_t>(k)].name;
    const bool written = std::any_of(kept.begin(), kept.end(), [&](const Material& m) { return m.name == name; });
    if (used.contains(k) || written) continue;
    scene.materials.erase(scene.materials.begin() + k);
    each_material(scene.objects, [&](int& material) { material -= material > k ? 1 : 0; });
  }
}

}  // namespace

std::vector<Object>& list_of(Scene& scene, const ObjectPath& path) {
  if (path.size() == 1) return scene.objects;
  Object& group = *find_object(scene, ObjectPath(path.begin(), path.end() - 1));
  return std::get<Group>(group.kind).objects;
}

ObjectPaths outermost(ObjectPaths paths) {
  std::sort(paths.begin(), paths.end());
  ObjectPaths result;
  for (const ObjectPath& path : paths)  // in this order a group stands before what is in it
    if (result.empty() || !starts_with(path, result.back())) result.push_back(path);
  return result;
}

std::string free_name(const Scene& scene, const std::string& wish) {
  std::set<std::string> names;
  collect_names(scene.objects, names);
  if (!names.contains(wish)) return wish;
  std::string stem = wish;
  int number = 1;
  const std::size_t space = wish.find_last_of(' ');
  const std::string end = space == std::string::npos ? "" : wish.substr(space + 1);
  const bool numbered = !end.empty() && end.size() < 7 &&
                        std::all_of(end.begin(), end.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
  if (numbered) stem = wish.substr(0, space), number = std::stoi(end);
  while (names.contains(stem + " " + std::to_string(++number))) {
  }
  return stem + " " + std::to_string(number);
}

ObjectPaths duplicate_objects(Scene& scene, const ObjectPaths& paths) {
  const ObjectPaths sources = with_linked_objects(scene, outermost(paths));
  ObjectPaths copies;
  for (std::size_t k = sources.size(); k-- > 0;) {  // from behind: the paths before stay as they are
    const ObjectPath& path = sources[k];
    Object copy = *find_object(scene, path);
    if (!copy.name.empty()) copy.name = free_name(scene, copy.name);
    std::vector<Object>& list = list_of(scene, path);
    list.insert(list.begin() + path.back() + 1, std::move(copy));
    for (ObjectPath& other : copies) {  // those behind it in the same list have moved by one
      const std::size_t level = path.size() - 1;
      if (other.size() > level && std::equal(path.begin(), path.end() - 1, other.begin()) && other[level] > path.back())
        ++other[level];
    }
    ObjectPath at = path;
    ++at.back();
    copies.push_back(std::move(at));
  }
  std::reverse(copies.begin(), copies.end());
  return copies;
}

int delete_objects(Scene& scene, const ObjectPaths& paths, const std::vector<Material>& kept) {
  const ObjectPaths all = with_linked_objects(scene, outermost(paths));
  for (std::size_t k = all.size(); k-- > 0;) {
    std::vector<Object>& list = list_of(scene, all[k]);
    list.erase(list.begin() + all[k].back());
  }
  delete_unused_materials(scene, kept);
  return static_cast<int>(all.size());
}

}  // namespace tyndall
