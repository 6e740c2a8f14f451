#include "core/scene/json_read.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

/// The thing that a value names. kind: "material", "texture".
int read_reference(const JsonValue& json, const Place& at, const NameTable& table, const std::string& kind) {
  const auto* name = std::get_if<std::string>(&json.value);
  const auto entry = name ? table.find(*name) : table.end();
  if (entry != table.end()) return entry->second;
  const std::string expected = "the name of a " + kind;
  if (!name) fail(at, describe(json), expected);
  std::vector<std::string_view> names;
  for (const auto& one : table) names.push_back(one.first);
  std::sort(names.begin(), names.end());
  std::string hint = did_you_mean(*name, names);
  if (names.empty()) hint = " (the scene has none)";
  if (hint.empty() && names.size() <= 12) hint = ": " + one_of(names);
  fail(at, in_quotes(shortened(*name, 80)), expected + hint);
}

Transform read_transform(const JsonObject& object, const Place& at) {
  Transform transform;
  const JsonValue* json = find(object, "transform");
  if (!json) return transform;
  const Place here{at, "transform"};
  const char* expected = "{ \"rotate_y\": degrees } or { \"translate\": [x, y, z] }";
  const JsonArray& steps =
      read_as<JsonArray>(*json, here, "a list of { \"rotate_y\": degrees } and { \"translate\": [x, y, z] }");
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const Place step{here, i};
    const JsonObject& members = read_as<JsonObject>(steps[i], step, expected);
    if (members.size() != 1) fail(step, "an object with " + std::to_string(members.size()) + " keys", expected);
    const auto read = [&](auto&& move) {
      const auto list = fields_of<std::decay_t<decltype(move)>>();
      if (members[0].key != std::get<0>(list).name) return false;
      read_fields(members, step, list, move);
      transform.emplace_back(move);
      return true;
    };
    if (!read(RotateY()) && !read(Translate()))
      fail({step, members[0].key}, "an unknown key",
           expected + did_you_mean(members[0].key, {"rotate_y", "translate"}));
  }
  return transform;
}

Volume read_volume(const JsonObject& json, const Place& at, const NameTables& references) {
  allow_keys(json, at, fields_of<Medium<>>(), {"name", "type", "boundary", "albedo", "transform"});
  Volume volume;
  const char* expected = "an object that describes a sphere or a box";
  const Place here{at, "boundary"};
  const JsonObject& boundary = read_as<JsonObject>(member_at(json, at, "boundary", expected), here, expected);
  if (find(boundary, "material"))
    fail({here, "material"}, "a material", "none: a boundary has no surface (add an object of the same shape for one)");
  read_kind(boundary, here, volume.boundary, [&]<class T>(T& shape) {
    read_fields(boundary, here, fields_of<T>(), {"type", "transform"}, shape);
  });
  volume.boundary_transform = read_transform(boundary, here);
  read_fields(json, at, fields_of<Medium<>>(), volume.medium);
  volume.albedo = read_colour(json, at, "albedo", references.textures);
  return volume;
}

std::vector<std::string_view> object_types() {
  auto types = type_names<decltype(Solid3d::shape)>();
  types.insert(types.end(), {Medium<>::type, "group"});
  return types;
}

void read_object(const JsonValue& json, const Place& at, const NameTables& references, Object& object) {
  const JsonObject& members = read_as<JsonObject>(json, at, "an object of the scene: { \"type\": …, … }");
  const std::string_view type = type_at(members, at, object_types);
  if (type == Medium<>::type) {
    object.kind = read_volume(members, at, references);
  } else if (type == "group") {
    allow_keys(members, at, {"name", "type", "transform", "objects"});
    const JsonValue& objects = member_at(members, at, "objects", "a list of objects");
    object.kind = Group{read_objects(objects, {at, "objects"}, references)};
  } else {
    Solid3d solid;
    const bool known = read_kind(type, solid.shape, [&]<class T>(T& shape) {
      read_fields(members, at, fields_of<T>(), {"name", "type", "material", "transform"}, shape);
    });
    if (!known) fail_type(at, type, object_types());
    const JsonValue& material = member_at(members, at, "material", "the name of a material");
    solid.material = read_reference(material, {at, "material"}, references.materials, "material");
    object.kind = solid;
  }
  if (const JsonValue* name = find(members, "name"))
    object.name = read_as<std::string>(*name, {at, "name"}, "a text (the object's name)");
  object.transform = read_transform(members, at);
}

/// Whether materials of a kind have that key, beside their type.
template <class Kind>
bool has_key(const Kind*, std::string_view key) {
  bool has = false;
  if constexpr (Kind::colour_name != nullptr) has = key == Kind::colour_name;
  for_each_field(fields_of<Kind>(), [&](const auto& field) { has = has || key == field.name; });
  return has;
}
template <class... Kinds>
bool has_key(const std::variant<Kinds...>*, std::string_view key) {
  return (has_key(static_cast<const Kinds*>(nullptr), key) || ...);
}

/// The colour that a material has under any name; grey if it has none.
JsonValue colour_of(const JsonObject& material) {
  for (const char* name : {"albedo", "radiance"})
    if (const JsonValue* colour = find(material, name)) return *colour;
  return to_json(std::get<Vec3d>(Material().colour));
}

}  // namespace

const JsonValue& member_at(const JsonObject& object, const Place& at, const char* key, std::string_view expected) {
  if (const JsonValue* json = find(object, key)) return *json;
  fail(at, "no " + in_quotes(key), std::string(expected));
}

void fail_key(const Place& at, std::string_view key, const std::vector<std::string_view>& known) {
  fail({at, key}, "an unknown key", one_of(known) + did_you_mean(key, known));
}

void read_value(const JsonValue& json, const Place& at, const Meaning& meaning, double& out) {
  const auto* number = std::get_if<double>(&json.value);
  if (!number) fail(at, describe(json), expected_text(meaning, Form::number));
  out = *number;
}

double whole_number(const JsonValue& json, const Place& at, Meaning meaning, double lowest, double highest) {
  const auto* number = std::get_if<double>(&json.value);
  const bool whole = number && *number == std::floor(*number);
  if (whole && *number >= lowest && *number <= highest) return *number;
  if (whole && *number > 0) meaning.valid.high = std::min(meaning.valid.high, highest);
  fail(at, describe(json), expected_text(meaning, Form::whole));
}

void read_value(const JsonValue& json, const Place& at, const Meaning& meaning, Vec3d& out) {
  const auto* array = std::get_if<JsonArray>(&json.value);
  if (!array || array->size() != 3) fail(at, describe(json), expected_text(meaning, Form::vector));
  double* const components[3] = {&out.x, &out.y, &out.z};
  for (std::size_t i = 0; i < 3; ++i) read_value((*array)[i], {at, i}, meaning, *components[i]);
}

void read_value(const JsonValue& json, const Place& at, const Meaning&, bool& out) {
  out = read_as<bool>(json, at, "true or false");
}

std::string_view type_at(const JsonObject& object, const Place& at, std::vector<std::string_view> (*types)()) {
  const JsonValue* json = find(object, "type");
  if (!json) fail(at, "no \"type\"", one_of(types()));
  if (const auto* type = std::get_if<std::string>(&json->value)) return *type;
  fail({at, "type"}, describe(*json), one_of(types()));
}

void fail_type(const Place& at, std::string_view found, const std::vector<std::string_view>& types) {
  fail({at, "type"}, in_quotes(shortened(found, 80)), one_of(types) + did_you_mean(found, types));
}

ColourOrTexture read_colour(const JsonObject& object, const Place& at, const char* colour_name,
                            const NameTable& textures) {
  const Meaning meaning = colour_meaning(colour_name);
  const std::string expected = expected_text(meaning, Form::vector) + " or the name of a texture";
  const JsonValue& json = member_at(object, at, colour_name, expected);
  const Place here{at, colour_name};
  if (std::holds_alternative<std::string>(json.value))
    return TextureIndex{read_reference(json, here, textures, "texture")};
  const auto* array = std::get_if<JsonArray>(&json.value);
  if (!array || array->size() != 3) fail(here, describe(json), expected);
  Vec3d colour;
  read_value(json, here, meaning, colour);
  return colour;
}

std::vector<Object> read_objects(const JsonValue& json, const Place& at, const NameTables& references) {
  const JsonArray& array = read_as<JsonArray>(json, at, "a list of objects");
  std::vector<Object> objects(array.size());
  for (std::size_t i = 0; i < array.size(); ++i) read_object(array[i], {at, i}, references, objects[i]);
  return objects;
}

void fit_to_type(JsonValue& root, const Override& override_) {
  const auto steps = pointer_steps(override_.pointer);
  if (!steps || steps->size() != 3 || steps->front() != "materials" || steps->back() != "type") return;
  JsonValue* value = find_value(root, {steps->begin(), steps->end() - 1});
  auto* material = value ? std::get_if<JsonObject>(&value->value) : nullptr;
  if (!material) return;
  MaterialKinds<double> kind;
  read_kind(text_of(find(*material, "type")), kind, [&]<class T>(T& own) {
    const JsonValue colour = colour_of(*material);
    std::erase_if(*material, [&](const JsonMember& m) { return has_key(&kind, m.key) && !has_key(&own, m.key); });
    if constexpr (T::colour_name != nullptr)
      if (!find(*material, T::colour_name)) put(*material, T::colour_name, colour);
    for_each_field(fields_of<T>(), [&](const auto& field) {
      if (field.required && !find(*material, field.name)) put(*material, field.name, own.*field.value);
    });
  });
}

}  // namespace tyndall
