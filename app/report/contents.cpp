#include "app/report/contents.h"

#include "core/base/text.h"

#include <type_traits>

namespace tyndall {
namespace {

template <class Kinds>
const char* type_of(const Kinds& kind) {
  return std::visit([](const auto& k) { return std::decay_t<decltype(k)>::type; }, kind);
}

void count(const Scene& scene, const Solid3d& solid, Contents& contents) {
  const Material& material = scene.materials[static_cast<std::size_t>(solid.material)];
  const int lights = std::holds_alternative<Light<double>>(material.kind) ? 1 : 0;
  if (const auto* sphere = std::get_if<Sphere<>>(&solid.shape)) {
    ++contents.shapes[sphere->center_end ? "moving sphere" : "sphere"];
    contents.lights += lights;
  } else {
    const auto* disk = std::get_if<Disk<>>(&solid.shape);
    ++contents.shapes[disk && disk->inner > 0 ? "ring" : type_of(solid.shape)];
    contents.lights += (std::holds_alternative<Box<>>(solid.shape) ? 6 : 1) * lights;
  }
}

void add_leaves(const std::vector<Object>& objects, ObjectPath& path, std::vector<ObjectPath>& out) {
  for (std::size_t i = 0; i < objects.size(); ++i) {
    path.push_back(static_cast<int>(i));
    if (const Group* group = std::get_if<Group>(&objects[i].kind))
      add_leaves(group->objects, path, out);
    else
      out.push_back(path);
    path.pop_back();
  }
}

std::string background_of(const Scene& scene) {
  if (std::holds_alternative<Gradient>(scene.background)) return Gradient::type;
  if (std::holds_alternative<Hemispheres>(scene.background)) return Hemispheres::type;
  if (std::holds_alternative<SkyPicture>(scene.background)) return SkyPicture::type;
  return std::get<Vec3d>(scene.background) == Vec3d{} ? "none" : "constant";
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
  ObjectPath path;
  add_leaves(scene.objects, path, out);
  return out;
}

Contents contents_of(const Scene& scene) {
  Contents contents;
  each_object(scene.objects, [&](const Object& object) {
    if (const auto* solid = std::get_if<Solid3d>(&object.kind)) count(scene, *solid, contents);
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
  contents.background = background_of(scene);
  return contents;
}

std::string alpha_note(const std::vector<std::string>& with_alpha) {
  if (with_alpha.empty()) return "";
  std::string names;
  for (const std::string& name : with_alpha) names += (names.empty() ? "" : ", ") + in_quotes(name);
  if (with_alpha.size() == 1)
    return "texture " + names + " has an alpha channel, which is not looked at: what is hidden beneath it is shown";
  return "textures " + names + " have alpha channels, which are not looked at: what is hidden beneath them is shown";
}

}  // namespace tyndall
