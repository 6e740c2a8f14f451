#include "app/report/names.h"

#include "core/base/text.h"

namespace tyndall {
namespace {

/// The innermost object on a path of indices, and its place in the file.
struct Named {
  const Object* object;
  std::string pointer;
};
Named object_at(const Scene& scene, const std::vector<int>& path) {
  const std::vector<Object>* list = &scene.objects;
  Named named{nullptr, ""};
  for (const int index : path) {
    named.object = &(*list)[static_cast<std::size_t>(index)];
    named.pointer += "/objects/" + std::to_string(index);
    if (const auto* group = std::get_if<Group>(&named.object->kind)) list = &group->objects;
  }
  return named;
}

}  // namespace

std::string object_text(const Scene& scene, const std::vector<int>& path) {
  const Named named = object_at(scene, path);
  const std::string name = named.object->name.empty() ? named.pointer : in_quotes(named.object->name);
  const auto* solid = std::get_if<Solid3d>(&named.object->kind);
  if (!solid) return printable(name);
  return printable(name + " (" + scene.materials[static_cast<std::size_t>(solid->material)].name + ")");
}

}  // namespace tyndall
