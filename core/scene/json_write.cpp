#include "core/base/kinds.h"
#include "core/scene/json_tree.h"
#include "core/scene/place.h"

#include <cassert>

namespace tyndall {
namespace {

/// A part of the scene that is left out where it says nothing.
void put_part(JsonObject& out, const char* key, JsonObject part) {
  if (!part.empty()) put(out, key, std::move(part));
}

struct Writer {
  const Scene& scene;
  const bool complete;  ///< writes also fields that are at their defaults, and null for those that are left open

  /// The fields that are required or differ from their defaults.
  template <class Fields, class Owner>
  void put_fields(JsonObject& out, const Fields& list, const Owner& owner) const {
    const Owner defaults{};
    for_each_field(list, [&](const auto& field) {
      if (complete || field.required || !(owner.*field.value == defaults.*field.value))
        put(out, field.name, owner.*field.value);
    });
  }

  template <class Owner>
  JsonObject fields_json(const Owner& owner) const {
    JsonObject out;
    put_fields(out, fields_of<Owner>(), owner);
    return out;
  }

  /// What a thing of one of several kinds says: its type, the file of a picture, the colour of a material, and its
  /// fields.
  template <class Kind>
  void put_kind(JsonObject& out, const Kind& kind, const ColourOrTexture& colour = {}) const {
    put(out, "type", Kind::type);
    if constexpr (requires { kind.file; }) put(out, "file", kind.file);
    if constexpr (requires { Kind::colour_name; })
      if constexpr (Kind::colour_name != nullptr) put(out, Kind::colour_name, colour_json(colour));
    if constexpr (requires { fields(&kind); }) put_fields(out, fields_of<Kind>(), kind);
  }

  JsonValue background_json() const {
    return std::visit(Overloaded{[](const Vec3d& radiance) { return to_json(radiance); },
                                 [&](const auto& sky) {
                                   JsonObject out;
                                   put_kind(out, sky);
                                   return JsonValue{std::move(out)};
                                 }},
                      scene.background);
  }

  JsonObject animation_json(const Animation& animation) const {
    JsonObject out = fields_json(animation), keyed;
    for (const KeyedValue& value : animation.keyed) {
      JsonObject keys;
      for (const KeyFrame& key : value.keys)
        put(keys, std::to_string(key.frame), key.value.size() == 1 ? to_json(key.value[0]) : to_json(key.value));
      put(keyed, value.pointer, std::move(keys));
    }
    put_part(out, "keys", std::move(keyed));
    return out;
  }

  JsonValue colour_json(const ColourOrTexture& colour) const {
    if (const auto* radiance = std::get_if<Vec3d>(&colour)) return to_json(*radiance);
    const auto index = static_cast<std::size_t>(std::get<TextureIndex>(colour).index);
    assert(index < scene.textures.size());
    return {scene.textures[index].name};
  }

  void put_transform(JsonObject& out, const Transform& transform) const {
    if (transform.empty()) return;
    JsonArray steps;
    for (const auto& move : transform) std::visit([&](const auto& m) { steps.push_back({fields_json(m)}); }, move);
    put(out, "transform", JsonValue{std::move(steps)});
  }

  void put_volume(JsonObject& out, const Volume& volume) const {
    put(out, "type", Medium<>::type);
    JsonObject boundary;
    std::visit([&](const auto& shape) { put_kind(boundary, shape); }, volume.boundary);
    put_transform(boundary, volume.boundary_transform);
    put(out, "boundary", std::move(boundary));
    const auto behind_density = static_cast<std::ptrdiff_t>(out.size()) + 1;
    put_fields(out, fields_of<Medium<>>(), volume.medium);
    out.insert(out.begin() + behind_density, {"albedo", colour_json(volume.albedo)});
  }

  JsonValue objects_json(const std::vector<Object>& objects) const {
    JsonArray array;
    array.reserve(objects.size());
    for (const Object& object : objects) {
      JsonObject out;
      if (!object.name.empty()) put(out, "name", object.name);
      std::visit(Overloaded{[&](const Solid3d& solid) {
                              std::visit([&](const auto& shape) { put_kind(out, shape); }, solid.shape);
                              put(out, "material", scene.materials[static_cast<std::size_t>(solid.material)].name);
                            },
                            [&](const Volume& volume) { put_volume(out, volume); },
                            [&](const Group&) { put(out, "type", "group"); }},
                 object.kind);
      put_transform(out, object.transform);
      if (const auto* group = std::get_if<Group>(&object.kind)) put(out, "objects", objects_json(group->objects));
      array.push_back({std::move(out)});
    }
    return {std::move(array)};
  }

  JsonValue scene_json() const {
    JsonObject root, image, camera = fields_json(scene.camera), textures, materials;
    put(root, "tyndall", 1);
    if (!scene.name.empty()) put(root, "name", scene.name);
    put_fields(image, image_fields(), scene);
    put_part(root, "image", std::move(image));
    if (scene.camera.shutter_open != 0 || scene.camera.shutter_close != 0)
      put(camera, "shutter", std::vector{scene.camera.shutter_open, scene.camera.shutter_close});
    put_part(root, "camera", std::move(camera));
    if (!(scene.background == Scene().background)) put(root, "background", background_json());
    put_part(root, "render", fields_json(scene.render));
    put_part(root, "display", fields_json(scene.display));
    if (scene.animation) put(root, "animation", animation_json(*scene.animation));
    for (const Texture& texture : scene.textures) {
      JsonObject out;
      std::visit([&](const auto& kind) { put_kind(out, kind); }, texture.kind);
      put(textures, texture.name, std::move(out));
    }
    put_part(root, "textures", std::move(textures));
    for (const Material& material : scene.materials) {
      JsonObject out;
      std::visit([&](const auto& kind) { put_kind(out, kind, material.colour); }, material.kind);
      put(materials, material.name, std::move(out));
    }
    put_part(root, "materials", std::move(materials));
    put(root, "objects", objects_json(scene.objects));
    return {std::move(root)};
  }
};

}  // namespace

JsonValue scene_json(const Scene& scene) { return Writer{scene, false}.scene_json(); }

std::string write_scene(const Scene& scene) { return print_json(scene_json(scene)); }

void add_sections(JsonValue& root) {
  auto& sections = std::get<JsonObject>(root.value);
  for (const char* section : {"camera", "render", "display", "textures", "materials"})
    if (!find(sections, section)) put(sections, section, JsonValue{JsonObject()});
}

std::optional<JsonValue> value_at_pointer(const Scene& scene, const std::string& pointer) {
  const auto steps = pointer_steps(pointer);
  for (const bool complete : {false, true}) {
    JsonValue root = Writer{scene, complete}.scene_json();
    if (const JsonValue* value = steps ? find_value(root, *steps) : nullptr) return *value;
  }
  return std::nullopt;
}

}  // namespace tyndall
