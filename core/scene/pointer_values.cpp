#include "core/scene/pointer_values.h"

#include "core/scene/check.h"
#include "core/scene/json_read.h"
#include "core/scene/place.h"

namespace tyndall {
namespace {

/// The value of a field of that name in `owner`; nothing if there is no such field.
template <class Owner>
std::optional<JsonValue> value_of(const Owner& owner, std::string_view key) {
  std::optional<JsonValue> found;
  for_each_field(fields_of<Owner>(), [&](const auto& field) {
    if (key == field.name) found = to_json(owner.*field.value);
  });
  return found;
}

/// What a field is where a thing of that type does not say it.
template <class... Kinds>
std::optional<JsonValue> default_of(std::string_view type, std::string_view key, const std::variant<Kinds...>*) {
  std::optional<JsonValue> found;
  const auto look = [&]<class Kind>(const Kind*) {
    if constexpr (requires { fields(static_cast<const Kind*>(nullptr)); })
      if (type == Kind::type && !found) found = value_of(Kind(), key);
  };
  (look(static_cast<const Kinds*>(nullptr)), ...);
  return found;
}

}  // namespace

void add_sections(JsonValue& root) {
  auto& sections = std::get<JsonObject>(root.value);
  for (const char* section : {"camera", "render", "display", "textures", "materials"})
    if (!find(sections, section)) put(sections, section, JsonValue{JsonObject()});
}

std::optional<JsonValue> unwritten_value(const Scene& scene, JsonValue& root, std::vector<std::string> steps) {
  if (steps.empty()) return std::nullopt;
  const std::string key = steps.back();
  steps.pop_back();
  if (steps == std::vector<std::string>{"camera"}) return value_of(scene.camera, key);
  if (steps == std::vector<std::string>{"render"}) return value_of(scene.render, key);
  if (steps == std::vector<std::string>{"display"}) return value_of(scene.display, key);
  const std::string type = text_of(find(find_value(root, steps), "type"));
  if (auto found = default_of(type, key, static_cast<const decltype(Material::kind)*>(nullptr))) return found;
  if (auto found = default_of(type, key, static_cast<const decltype(Texture::kind)*>(nullptr))) return found;
  if (auto found = default_of(type, key, static_cast<const decltype(Solid3d::shape)*>(nullptr))) return found;
  return default_of(type, key, static_cast<const std::variant<Medium<>>*>(nullptr));
}

std::optional<JsonValue> value_at_pointer(const Scene& scene, const std::string& pointer) {
  const auto steps = pointer_steps(pointer);
  if (!steps) return {};
  JsonValue root = scene_json(scene);
  if (const JsonValue* written = find_value(root, *steps)) return *written;
  return unwritten_value(scene, root, *steps);
}

Scene with_value(const Scene& scene, const std::string& pointer, JsonValue value) {
  JsonValue root = scene_json(scene);
  add_sections(root);
  put_value(root, pointer_steps(pointer).value_or(std::vector<std::string>{""}), std::move(value), pointer);
  return checked(scene_with_pictures(root, scene));
}

}  // namespace tyndall
