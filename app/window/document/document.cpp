#include "app/window/document/document.h"

#include "core/scene/frames.h"
#include "core/scene/json_tree.h"
#include "core/scene/place.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

namespace tyndall {
namespace {

using Objects = std::vector<Object>;

/// The index of the object in `after` that equals before[from]; of several equal ones, that with the same number.
std::optional<std::size_t> equal_object(const Objects& before, const Objects& after, std::size_t from) {
  const Object& object = before[from];
  if (from < after.size() && after[from] == object) return from;
  auto number = std::count(before.begin(), before.begin() + static_cast<std::ptrdiff_t>(from), object);
  for (std::size_t k = 0; k < after.size(); ++k)
    if (after[k] == object && number-- == 0) return k;
  return {};
}

/// The index of an object in another state of its list; nothing: it is gone.
std::optional<std::size_t> index_after(const Objects& before, const Objects& after, std::size_t from) {
  if (const auto equal = equal_object(before, after, from)) return equal;
  const std::string& name = before[from].name;
  const auto has_name = [&](const Object& object) { return object.name == name; };
  const auto named = std::find_if(after.begin(), after.end(), has_name);
  if (!name.empty() && named != after.end()) return named - after.begin();
  if (before.size() == after.size()) return from;
  if (!name.empty() || std::find(after.begin(), after.end(), before[from]) != after.end()) return {};
  // The list grew or shrank, so what stands before and behind that place is still the same.
  const auto [was, is] = std::mismatch(before.begin(), before.end(), after.begin(), after.end());
  if (from < static_cast<std::size_t>(was - before.begin())) return from;
  const auto same_end =
      std::mismatch(before.rbegin(), std::make_reverse_iterator(was), after.rbegin(), std::make_reverse_iterator(is))
          .first -
      before.rbegin();
  if (from + static_cast<std::size_t>(same_end) < before.size()) return {};
  return from + after.size() - before.size();
}

ObjectPath path_after(const Objects& before, const Objects& after, const ObjectPath& path, std::size_t level = 0) {
  const auto from = static_cast<std::size_t>(path[level]);
  const auto to = index_after(before, after, from);
  if (!to) return {};
  ObjectPath found{static_cast<int>(*to)};
  if (level + 1 == path.size()) return found;
  const Group *was = std::get_if<Group>(&before[from].kind), *is = std::get_if<Group>(&after[*to].kind);
  const ObjectPath rest = was && is ? path_after(was->objects, is->objects, path, level + 1) : ObjectPath{};
  if (rest.empty()) return {};
  found.insert(found.end(), rest.begin(), rest.end());
  return found;
}

}  // namespace

Object* find_object(Scene& scene, const ObjectPath& path) {
  return const_cast<Object*>(find_object(static_cast<const Scene&>(scene), path));
}

ObjectPaths paths_after(const Scene& before, const Scene& after, const ObjectPaths& paths) {
  ObjectPaths found;
  for (const ObjectPath& path : paths) {
    if (!find_object(before, path)) continue;
    ObjectPath now = path_after(before.objects, after.objects, path);
    if (!now.empty()) found.push_back(std::move(now));
  }
  return found;
}

namespace {

/// Whether some value that has keys could have moved or gone: objects or kinds of materials are others.
bool has_other_things(const Scene& before, const Scene& after) {
  const auto kinds_of = [](const Scene& scene) {
    std::vector<std::size_t> kinds;
    for (const Material& material : scene.materials) kinds.push_back(material.kind.index());
    return kinds;
  };
  return !(before.objects == after.objects) || kinds_of(before) != kinds_of(after) ||
         before.background.index() != after.background.index();
}

/// The steps of a pointer that lead to an object, as its path: those of "/objects/3/objects/0/radius" are {3, 0}.
ObjectPath object_of(const std::vector<std::string>& steps) {
  ObjectPath path;
  for (std::size_t k = 0; k + 1 < steps.size() && steps[k] == "objects"; k += 2)
    path.push_back(std::atoi(steps[k + 1].c_str()));
  return path;
}

}  // namespace

void move_keys(const Scene& before, Scene& after) {
  if (!after.animation || !before.animation || !has_other_things(before, after)) return;
  std::erase_if(after.animation->keyed, [&](KeyedValue& keyed) {
    auto steps = pointer_steps(keyed.pointer).value_or(std::vector<std::string>{});
    const ObjectPath path = object_of(steps);
    if (path.empty()) return false;
    const ObjectPaths now = paths_after(before, after, {path});
    if (now.empty() || now[0].size() != path.size()) return true;
    for (std::size_t k = 0; k < path.size(); ++k) steps[2 * k + 1] = std::to_string(now[0][k]);
    keyed.pointer.clear();
    for (const std::string& step : steps) keyed.pointer += "/" + pointer_step(step);
    return false;
  });
  drop_lost_keys(after);
  if (after.animation->keyed.empty()) after.animation.reset();
}

}  // namespace tyndall
