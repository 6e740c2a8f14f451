#include "core/scene/json_read.h"

#include <algorithm>
#include <set>

namespace tyndall {
namespace {

/// The keys of a material of that kind but its type.
template <class Kind>
std::set<std::string_view> keys_of(const Kind*) {
  std::set<std::string_view> keys;
  for_each_field(fields_of<Kind>(), [&](const auto& field) { keys.insert(field.name); });
  if constexpr (Kind::colour_name != nullptr) keys.insert(Kind::colour_name);
  return keys;
}

template <class... Kinds>
std::set<std::string_view> keys_of_all(const std::variant<Kinds...>*) {
  std::set<std::string_view> keys;
  (keys.merge(keys_of(static_cast<const Kinds*>(nullptr))), ...);
  return keys;
}

/// The colour that a material has under any name; grey if it has none.
JsonValue colour_of(const JsonObject& material) {
  for (const char* name : {"albedo", "radiance"})
    if (const JsonValue* colour = find(material, name)) return *colour;
  return to_json(std::get<Vec3d>(Material().colour));
}

}  // namespace

void fit_to_type(JsonValue& root, const Override& override_) {
  const auto steps = pointer_steps(override_.pointer);
  if (!steps || steps->size() != 3 || steps->front() != "materials" || steps->back() != "type") return;
  JsonValue* value = find_value(root, {steps->begin(), steps->end() - 1});
  auto* material = value ? std::get_if<JsonObject>(&value->value) : nullptr;
  if (!material) return;
  MaterialKinds<double> kind;
  read_kind(text_of(find(*material, "type")), kind, [&]<class T>(T&) {
    const JsonValue colour = colour_of(*material);
    const std::set<std::string_view> own = keys_of(static_cast<const T*>(nullptr));
    const std::set<std::string_view> all = keys_of_all(static_cast<const MaterialKinds<double>*>(nullptr));
    std::erase_if(*material, [&](const JsonMember& m) { return all.contains(m.key) && !own.contains(m.key); });
    if constexpr (T::colour_name != nullptr)
      if (!find(*material, T::colour_name)) put(*material, T::colour_name, colour);
    for_each_field(fields_of<T>(), [&](const auto& field) {
      if (field.required && !find(*material, field.name)) put(*material, field.name, T().*field.value);
    });
  });
}

}  // namespace tyndall
