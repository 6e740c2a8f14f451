#include "core/base/kinds.h"
#include "core/scene/json_tree.h"
#include "core/scene/place.h"

#include <cassert>

namespace tyndall {
namespace {

enum class Which { all, required, optional };

/// The fields that are required or differ from their defaults.
template <class Fields, class Owner>
void put_fields(JsonObject& out, const Fields& list, const Owner& owner, Which which = Which::all) {
  const Owner defaults{};
  for_each_field(list, [&](const auto& field) {
    if (which != Which::all && field.required != (which == Which::required)) return;
    if (field.required || !(owner.*field.value == defaults.*field.value)) put(out, field.name, owner.*field.value);
  });
}
template <class Owner>
void put_fields(JsonObject& out, const Owner& owner, Which which = Which::all) {
  put_fields(out, fields_of<Owner>(), owner, which);
}

/// A part of the scene that is left out where it says nothing.
void put_part(JsonObject& out, const char* key, JsonObject part) {
  if (!part.empty()) put(out, key, JsonValue{std::move(part)});
}

template <class Owner>
JsonObject fields_json(const Owner& owner) {
  JsonObject out;
  put_fields(out, owner);
  return out;
}

/// What a thing of one of several kinds says: its type, the file of a picture, and its fields.
template <class Kind>
void put_kind(JsonObject& out, const Kind& kind) {
  put(out, "type", Kind::type);
  if constexpr (requires { kind.file; }) put(out, "file", kind.file);
  if constexpr (requires { fields(&kind); }) put_fields(out, kind);
}

JsonObject camera_json(const Camera& camera) {
  JsonObject out = fields_json(camera);
  if (camera.shutter_open != 0 || camera.shutter_close != 0)
    put(out, "shutter", std::vector{camera.shutter_open, camera.shutter_close});
  return out;
}

JsonValue background_json(const Background& background) {
  return std::visit(Overloaded{[](const Vec3d& radiance) { return to_json(radiance); },
                               [](const auto& sky) {
                                 JsonObject out;
                                 put_kind(out, sky);
                                 return JsonValue{std::move(out)};
                               }},
                    background);
}

JsonObject animation_json(const Animation& animation) {
  JsonObject out = fields_json(animation), keyed;
  for (const KeyedValue& value : animation.keyed) {
    JsonObject keys;
    for (const KeyFrame& key : value.keys)
      put(keys, std::to_string(key.frame), key.value.size() == 1 ? to_json(key.value[0]) : to_json(key.value));
    put(keyed, value.pointer, JsonValue{std::move(keys)});
  }
  put_part(out, "keys", std::move(keyed));
  return out;
}

JsonValue texture_json(const Texture& texture) {
  JsonObject out;
  std::visit([&](const auto& kind) { put_kind(out, kind); }, texture.kind);
  return {std::move(out)};
}

JsonValue colour_json(const ColourOrTexture& colour, const Scene& scene) {
  if (const auto* radiance = std::get_if<Vec3d>(&colour)) return to_json(*radiance);
  const auto index = static_cast<std::size_t>(std::get<TextureIndex>(colour).index);
  assert(index < scene.textures.size());
  return {scene.textures[index].name};
}

JsonValue material_json(const Material& material, const Scene& scene) {
  JsonObject out;
  std::visit(
      [&]<class T>(const T& kind) {
        put(out, "type", T::type);
        if constexpr (T::colour_name != nullptr) put(out, T::colour_name, colour_json(material.colour, scene));
        put_fields(out, kind);
      },
      material.kind);
  return {std::move(out)};
}

void put_transform(JsonObject& out, const Transform& transform) {
  if (transform.empty()) return;
  JsonArray steps;
  for (const auto& move : transform) std::visit([&](const auto& m) { steps.push_back({fields_json(m)}); }, move);
  put(out, "transform", JsonValue{std::move(steps)});
}

void put_volume(JsonObject& out, const Volume& volume, const Scene& scene) {
  put(out, "type", Medium<>::type);
  JsonObject boundary;
  std::visit([&](const auto& shape) { put_kind(boundary, shape); }, volume.boundary);
  put_transform(boundary, volume.boundary_transform);
  put(out, "boundary", JsonValue{std::move(boundary)});
  put_fields(out, volume.medium, Which::required);
  put(out, "albedo", colour_json(volume.albedo, scene));
  put_fields(out, volume.medium, Which::optional);
}

JsonValue objects_json(const std::vector<Object>& objects, const Scene& scene) {
  JsonArray array;
  array.reserve(objects.size());
  for (const Object& object : objects) {
    JsonObject out;
    if (!object.name.empty()) put(out, "name", object.name);
    std::visit(Overloaded{[&](const Solid3d& solid) {
                            std::visit([&](const auto& shape) { put_kind(out, shape); }, solid.shape);
                            put(out, "material", scene.materials[static_cast<std::size_t>(solid.material)].name);
                          },
                          [&](const Volume& volume) { put_volume(out, volume, scene); },
                          [&](const Group&) { put(out, "type", "group"); }},
               object.kind);
    put_transform(out, object.transform);
    if (const auto* group = std::get_if<Group>(&object.kind)) put(out, "objects", objects_json(group->objects, scene));
    array.push_back({std::move(out)});
  }
  return {std::move(array)};
}

}  // namespace

JsonValue scene_json(const Scene& scene) {
  JsonObject root, image, textures, materials;
  put(root, "tyndall", 1);
  if (!scene.name.empty()) put(root, "name", scene.name);
  put_fields(image, image_fields(), scene);
  put_part(root, "image", std::move(image));
  put_part(root, "camera", camera_json(scene.camera));
  if (!(scene.background == Scene().background)) put(root, "background", background_json(scene.background));
  put_part(root, "render", fields_json(scene.render));
  put_part(root, "display", fields_json(scene.display));
  if (scene.animation) put(root, "animation", JsonValue{animation_json(*scene.animation)});
  for (const Texture& texture : scene.textures) textures.push_back({texture.name, texture_json(texture)});
  put_part(root, "textures", std::move(textures));
  for (const Material& material : scene.materials) materials.push_back({material.name, material_json(material, scene)});
  put_part(root, "materials", std::move(materials));
  put(root, "objects", objects_json(scene.objects, scene));
  return {std::move(root)};
}

std::string write_scene(const Scene& scene) { return print_json(scene_json(scene)); }

}  // namespace tyndall
