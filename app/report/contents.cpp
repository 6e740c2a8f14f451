#include "app/report/contents.h"

#include "core/base/text.h"

namespace tyndall {
namespace {

template <class Kind>
constexpr const char* type_name = Kind::type;
template <>
constexpr const char* type_name<Vec3d> = "constant";

const char* type_of(const auto& kinds) {
  return std::visit([]<class Kind>(const Kind&) { return type_name<Kind>; }, kinds);
}

}  // namespace

const Object* find_object(const Scene& scene, const ObjectPath& path) {
  const std::vector<Object>* objects = &scene.objects;
  const Object* object = nullptr;
  for (const int index : path) {
    if (!objects || index < 0 || static_cast<std::size_t>(index) >= objects->size()) return nullptr;
    object = &(*objects)[static_cast<std::size_t>(index)];
    const Group* group = std::get_if<Group>(&object->kind);
    objects = group ? &group->objects : nullptr;
  }
  return object;
}

std::vector<ObjectPath> leaves(const Scene& scene) {
  std::vector<ObjectPath> out;
  const auto add = [&out](const auto& self, const std::vector<Object>& objects, ObjectPath path) -> void {
    for (path.push_back(0); const Object& object : objects) {
      if (const Group* group = std::get_if<Group>(&object.kind))
        self(self, group->objects, path);
      else
        out.push_back(path);
      ++path.back();
    }
  };
  add(add, scene.objects, {});
  return out;
}

Contents contents_of(const Scene& scene) {
  Contents contents;
  each_object(scene.objects, [&](const Object& object) {
    if (const auto* solid = std::get_if<Solid3d>(&object.kind)) {
      const auto* sphere = std::get_if<Sphere<>>(&solid->shape);
      const auto* disk = std::get_if<Disk<>>(&solid->shape);
      const bool moves = sphere && sphere->center_end, has_hole = disk && disk->inner > 0;
      ++contents.shapes[moves ? "moving sphere" : has_hole ? "ring" : type_of(solid->shape)];
      if (std::holds_alternative<Light<double>>(scene.materials[static_cast<std::size_t>(solid->material)].kind))
        contents.lights += std::holds_alternative<Box<>>(solid->shape) ? 6 : 1;
    }
    const auto* volume = std::get_if<Volume>(&object.kind);
    contents.media += volume ? 1 : 0;
    contents.phase_functions += volume && volume->medium.g != 0 ? 1 : 0;
  });
  for (const Material& material : scene.materials) ++contents.materials[type_of(material.kind)];
  for (const Texture& texture : scene.textures) {
    ++contents.textures[type_of(texture.kind)];
    const auto* image = std::get_if<Image>(&texture.kind);
    if (image && image->pixels && image->pixels->has_alpha) contents.with_alpha.push_back(texture.name);
  }
  contents.motion =
      contents.shapes.count("moving sphere") > 0 && scene.camera.shutter_close > scene.camera.shutter_open;
  contents.defocus = scene.camera.defocus_angle > 0;
  contents.background = scene.background == Background(Vec3d{}) ? "none" : type_of(scene.background);
  return contents;
}

std::string alpha_note(std::vector<std::string> with_alpha) {
  if (with_alpha.empty()) return "";
  for (std::string& name : with_alpha) name = in_quotes(name);
  const std::string names = joined(with_alpha);
  if (with_alpha.size() == 1)
    return "texture " + names + " has an alpha channel, which is not looked at: what is hidden beneath it is shown";
  return "textures " + names + " have alpha channels, which are not looked at: what is hidden beneath them is shown";
}

}  // namespace tyndall
