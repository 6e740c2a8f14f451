#include "core/scene/pointer_values.h"

#include "core/scene/check.h"
#include "core/scene/json_read.h"
#include "core/scene/place.h"

#include <algorithm>

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

bool is_numbers(const JsonValue& json) {
  const auto* array = std::get_if<JsonArray>(&json.value);
  return array && std::all_of(array->begin(), array->end(),
                              [](const JsonValue& item) { return std::holds_alternative<double>(item.value); });
}

bool same(const JsonValue& a, const JsonValue& b) { return print_json(a) == print_json(b); }

void find_changes(const JsonValue& before, const JsonValue& after, const std::string& at,
                  std::vector<std::string>& found);

/// The same of the members of objects, of which either may lack some.
void find_changed_members(const JsonObject& before, const JsonObject& after, const std::string& at,
                          std::vector<std::string>& found) {
  for (const JsonMember& member : before) {
    const std::string place = at + "/" + pointer_step(member.key);
    if (const JsonValue* now = find(after, member.key))
      find_changes(member.value, *now, place, found);
    else
      found.push_back(place);
  }
  for (const JsonMember& member : after)
    if (!find(before, member.key)) found.push_back(at + "/" + pointer_step(member.key));
}

/// Adds the pointers to all values that differ; vectors of numbers count as one.
void find_changes(const JsonValue& before, const JsonValue& after, const std::string& at,
                  std::vector<std::string>& found) {
  const auto *a = std::get_if<JsonObject>(&before.value), *b = std::get_if<JsonObject>(&after.value);
  if (a && b) return find_changed_members(*a, *b, at, found);
  const auto *list = std::get_if<JsonArray>(&before.value), *other = std::get_if<JsonArray>(&after.value);
  if (list && other && list->size() == other->size() && !is_numbers(before)) {
    for (std::size_t i = 0; i < list->size(); ++i)
      find_changes((*list)[i], (*other)[i], at + "/" + std::to_string(i), found);
    return;
  }
  if (!same(before, after)) found.push_back(at);
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
  if (const auto found = default_of(type, key, static_cast<const decltype(Material::kind)*>(nullptr))) return found;
  if (const auto found = default_of(type, key, static_cast<const decltype(Texture::kind)*>(nullptr))) return found;
  if (const auto found = default_of(type, key, static_cast<const decltype(Solid3d::shape)*>(nullptr))) return found;
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
  Scene changed = scene_with_pictures(root, scene);
  if (const auto error = check(changed)) throw *error;
  return changed;
}

std::optional<std::string> pointer_of_change(const Scene& before, const Scene& after) {
  JsonValue a = scene_json(before), b = scene_json(after);
  add_sections(a);
  add_sections(b);
  std::vector<std::string> found;
  find_changes(a, b, "", found);
  return found.size() == 1 ? std::optional(found[0]) : std::nullopt;
}

}  // namespace tyndall
