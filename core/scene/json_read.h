#pragma once
#include "core/base/choice.h"
#include "core/base/text.h"
#include "core/scene/json_tree.h"
#include "core/scene/place.h"

#include <algorithm>
#include <concepts>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>
#include <string_view>
#include <tuple>
#include <unordered_map>

/// Reads typed values out of a JSON tree, guided by fields(), and objects and colours, which refer by name to the
/// materials and textures that were read before them. All throw ParseError where a type is wrong; check() looks at
/// ranges later.
namespace tyndall {

/// What a value holds. If it is of another type than T, the message says that `expected` was expected.
template <class T>
const T& read_as(const JsonValue& json, const Place& at, std::string_view expected) {
  if (const T* value = std::get_if<T>(&json.value)) return *value;
  fail(at, describe(json), std::string(expected));
}

/// The value of a key that must be there. expected: what the message says of it where it is not.
const JsonValue& member_at(const JsonObject& object, const Place& at, const char* key, std::string_view expected);

/// Refuses a key, of which these are known.
[[noreturn]] void fail_key(const Place& at, std::string_view key, const std::vector<std::string_view>& known);

/// Refuses keys that are neither those of a list of fields nor in `more`.
template <class Fields>
void allow_keys(const JsonObject& object, const Place& at, const Fields& list,
                std::initializer_list<std::string_view> more) {
  for (const JsonMember& member : object) {
    const bool known = std::find(more.begin(), more.end(), member.key) != more.end() ||
                       std::apply([&](const auto&... field) { return ((member.key == field.name) || ...); }, list);
    if (known) continue;
    std::vector<std::string_view> keys(more);
    for_each_field(list, [&](const auto& field) { keys.emplace_back(field.name); });
    fail_key(at, member.key, keys);
  }
}
inline void allow_keys(const JsonObject& object, const Place& at, std::initializer_list<std::string_view> known) {
  allow_keys(object, at, std::tuple(), known);
}

void read_value(const JsonValue& json, const Place& at, const Meaning& meaning, double& out);
void read_value(const JsonValue& json, const Place& at, const Meaning& meaning, Vec3d& out);
void read_value(const JsonValue& json, const Place& at, const Meaning& meaning, bool& out);
/// Refuses numbers that are not whole, or beyond these limits.
double whole_number(const JsonValue& json, const Place& at, Meaning meaning, double lowest, double highest);
template <std::integral T>
void read_value(const JsonValue& json, const Place& at, const Meaning& meaning, T& out) {
  using Of = std::numeric_limits<T>;
  out = static_cast<T>(whole_number(json, at, meaning, Of::min(), Of::max()));
}
template <NamedEnum E>
void read_value(const JsonValue& json, const Place& at, const Meaning&, E& out) {
  const std::vector<std::string_view> names = names_of<E>();
  const std::string& name = read_as<std::string>(json, at, one_of(names));
  const std::optional<E> value = value_named<E>(name);
  if (!value) fail(at, describe(json), one_of(names) + did_you_mean(name, names));
  out = *value;
}
template <class T>
void read_value(const JsonValue& json, const Place& at, const Meaning& meaning, std::optional<T>& out) {
  read_value(json, at, meaning, out.emplace());
}

/// What is expected where a value of type T stands.
template <class T>
std::string expected_value(const Meaning& meaning) {
  if constexpr (NamedEnum<T>)
    return one_of(names_of<T>());
  else if constexpr (std::is_same_v<T, bool>)
    return "true or false";
  else
    return expected_text(meaning, std::is_same_v<T, Vec3d> ? Form::vector
                                  : std::is_integral_v<T>  ? Form::whole
                                                           : Form::number);
}

/// One field of `out`, if it is there; required fields must be.
template <class Owner, class T>
void read_field(const JsonObject& object, const Place& at, const Field<Owner, T>& field, Owner& out) {
  if (const JsonValue* json = find(object, field.name)) {
    read_value(*json, {at, field.name}, meaning_of(field), out.*field.value);
  } else if (field.required) {
    fail(at, "no " + in_quotes(field.name), expected_value<T>(meaning_of(field)));
  }
}

template <class Fields, class Owner>
void read_fields(const JsonObject& object, const Place& at, const Fields& list, Owner& out) {
  for_each_field(list, [&](const auto& field) { read_field(object, at, field, out); });
}

/// The same, where keys that are neither of the list nor in `more` are refused.
template <class Fields, class Owner>
void read_fields(const JsonObject& object, const Place& at, const Fields& list,
                 std::initializer_list<std::string_view> more, Owner& out) {
  allow_keys(object, at, list, more);
  read_fields(object, at, list, out);
}

/// The "type" of an object; where it is missing, the message lists those that `types` returns.
std::string_view type_at(const JsonObject& object, const Place& at, std::vector<std::string_view> (*types)());
[[noreturn]] void fail_type(const Place& at, std::string_view found, const std::vector<std::string_view>& types);

template <class... Kinds>
std::vector<std::string_view> type_names(const std::variant<Kinds...>*) {
  return {Kinds::type...};
}
template <class Variant>
std::vector<std::string_view> type_names() {
  return type_names(static_cast<const Variant*>(nullptr));
}

/// Makes `out` the kind of that type name and hands it to `read`; false if there is none.
template <class... Kinds, class Read>
bool read_kind(std::string_view type, std::variant<Kinds...>& out, const Read& read) {
  return ((type == Kinds::type && (read(out.template emplace<Kinds>()), true)) || ...);
}
/// The same by the "type" of an object. Refuses one that names no kind.
template <class Variant, class Read>
void read_kind(const JsonObject& object, const Place& at, Variant& out, const Read& read) {
  const std::string_view type = type_at(object, at, type_names<Variant>);
  if (!read_kind(type, out, read)) fail_type(at, type, type_names<Variant>());
}

/// Index of each texture or material by its name. The names must outlive it.
using NameTable = std::unordered_map<std::string_view, int>;

struct NameTables {
  NameTable textures, materials;
};

/// The colour under colour_name ("albedo" or "radiance"), which must be there: three numbers or a texture's name.
ColourOrTexture read_colour(const JsonObject& object, const Place& at, const char* colour_name,
                            const NameTable& textures);

/// After an override of a material's type: leaves out values that other types have and the new one lacks; its colour
/// stays, under the name that the new type has for it.
void fit_to_type(JsonValue& root, const Override& override_);

/// The scene of a document whose image files were read before: they are taken from a scene that has the same ones.
Scene scene_with_pictures(const JsonValue& root, const Scene& pictures);

/// The checked scene of a document. folder: where its relative image files are.
Scene scene_with_files(const JsonValue& root, const std::filesystem::path& folder);

/// The picture of a sky. file: as the scene names it, from the folder.
std::shared_ptr<const Image::Pixels> read_sky_pixels(const std::string& file, const std::filesystem::path& folder,
                                                     const Place& at);

std::vector<Object> read_objects(const JsonValue& json, const Place& at, const NameTables& references);

}  // namespace tyndall
