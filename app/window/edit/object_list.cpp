#include "app/window/edit/object_list.h"

#include "app/window/edit/companions.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <set>
#include <utility>

namespace tyndall {
namespace {

bool starts_with(const ObjectPath& path, const ObjectPath& start) {
  return path.size() >= start.size() && std::equal(start.begin(), start.end(), path.begin());
}

/// The list that holds the object at a path.
std::vector<Object>& list_of(Scene& scene, const ObjectPath& path) {
  if (path.size() == 1) return scene.objects;
  Object& group = *find_object(scene, ObjectPath(path.begin(), path.end() - 1));
  return std::get<Group>(group.kind).objects;
}

ObjectPaths with_companions(const Scene& scene, const ObjectPaths& paths) {
  ObjectPaths all = paths;
  for (const ObjectPath& path : paths)
    for (const ObjectPath& other : companions(scene, path)) all.push_back(other);
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

using Objects = std::vector<Object>;

/// How many objects two lists share at the beginning and at the end.
struct Shared {
  std::size_t start = 0, end = 0;
};
Shared shared(const Objects& before, const Objects& after) {
  const auto [was, is] = std::mismatch(before.begin(), before.end(), after.begin(), after.end());
  const auto [last_was, last_is] =
      std::mismatch(before.rbegin(), std::make_reverse_iterator(was), after.rbegin(), std::make_reverse_iterator(is));
  return {static_cast<std::size_t>(was - before.begin()), static_cast<std::size_t>(last_was - before.rbegin())};
}

/// Adds the objects that came between the beginning and the end that both lists share.
void add_new(const Objects& before, const Objects& after, ObjectPath& path, ObjectPaths& out) {
  const Shared same = shared(before, after);
  const bool as_many = before.size() == after.size();
  for (std::size_t k = same.start; k + same.end < after.size(); ++k) {
    path.push_back(static_cast<int>(k));
    const Group *was = as_many ? std::get_if<Group>(&before[k].kind) : nullptr,
                *is = std::get_if<Group>(&after[k].kind);
    if (!as_many)
      out.push_back(path);
    else if (was && is)
      add_new(was->objects, is->objects, path, out);
    path.pop_back();
  }
}

/// Where the object at a path is afterwards; empty: nowhere.
ObjectPath path_after(const Objects& before, const Objects& after, const ObjectPath& path, std::size_t level = 0) {
  const Shared same = shared(before, after);
  const auto from = static_cast<std::size_t>(path[level]);
  std::size_t to = from;
  if (from >= same.start && before.size() != after.size()) {
    if (from + same.end < before.size()) return {};
    to = from + after.size() - before.size();
  }
  if (level + 1 == path.size()) return {static_cast<int>(to)};
  const Group *was = std::get_if<Group>(&before[from].kind), *is = std::get_if<Group>(&after[to].kind);
  ObjectPath rest = was && is ? path_after(was->objects, is->objects, path, level + 1) : ObjectPath{};
  if (!rest.empty()) rest.insert(rest.begin(), static_cast<int>(to));
  return rest;
}

}  // namespace

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
  const ObjectPaths sources = with_companions(scene, outermost(paths));
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
  const ObjectPaths all = with_companions(scene, outermost(paths));
  for (std::size_t k = all.size(); k-- > 0;) {
    std::vector<Object>& list = list_of(scene, all[k]);
    list.erase(list.begin() + all[k].back());
  }
  delete_unused_materials(scene, kept);
  return static_cast<int>(all.size());
}

ObjectPaths selection_after(const Scene& before, const Scene& after, const ObjectPaths& selected) {
  ObjectPaths found;
  for (const ObjectPath& path : selected)
    if (find_object(before, path))
      if (ObjectPath now = path_after(before.objects, after.objects, path); !now.empty())
        found.push_back(std::move(now));
  ObjectPath path;
  if (found.empty()) add_new(before.objects, after.objects, path, found);
  return found;
}

}  // namespace tyndall
