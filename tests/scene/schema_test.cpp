#include "core/base/choice.h"
#include "core/scene/json_tree.h"
#include "core/scene/place.h"
#include "core/system/process.h"
#include "tests/scene/files.h"
#include "tests/support/paths.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <cctype>
#include <cmath>
#include <fstream>
#include <set>

/// assets/scene.schema.json, for editors: what follows from the lists of fields, which reading and writing use, is held
/// to them. After a change of a list write it anew with
///
///   TYNDALL_WRITE_SCHEMA=1 build/release/tests/core_tests -tc='schema*'
namespace tyndall::test::schema_test {

using Json = nlohmann::ordered_json;
namespace {

const std::filesystem::path file = assets_folder() / "scene.schema.json";

/// "Vertical field of view, full angle (degrees)."
std::string sentence(std::string words, const std::string& unit) {
  words[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(words[0])));
  return words + (unit == "°" ? " (degrees)." : ".");
}

/// The name of the shared definition that describes a vector with this range.
std::string vector_name(const Valid& valid) {
  if (valid.low == 0) return valid.high == 1 ? "share" : "radiance";
  return "vector";
}

template <class T>
void add_type(Json& out, const Valid& valid, const T*) {
  if constexpr (NamedEnum<T>) {
    for (const std::string_view name : names_of<T>()) out["enum"].push_back(name);
  } else if constexpr (std::is_same_v<T, Vec3d>) {
    out["$ref"] = "#/$defs/" + vector_name(valid);
  } else {
    out["type"] = std::is_same_v<T, bool> ? "boolean" : std::is_same_v<T, double> ? "number" : "integer";
    if (std::isfinite(valid.low)) out[valid.low_open ? "exclusiveMinimum" : "minimum"] = valid.low;
    if (std::isfinite(valid.high)) out[valid.high_open ? "exclusiveMaximum" : "maximum"] = valid.high;
    if (valid.nonzero) out["not"] = {{"const", 0}};
  }
}
template <class T>
void add_type(Json& out, const Valid& valid, const std::optional<T>*) {
  add_type(out, valid, static_cast<const T*>(nullptr));
}

template <class T>
std::string choices(const T*) {
  std::string words;
  if constexpr (NamedEnum<T>)
    for (int i = 0; i < count_of<T>(); ++i) {
      const Label choice = label(static_cast<T>(i));
      words += std::string(i > 0 ? "; " : ": ") + choice.name + ", " + choice.help;
    }
  return words;
}

template <class Owner, class T>
Json property(const Field<Owner, T>& field) {
  Json out;
  add_type(out, field.valid, static_cast<const T*>(nullptr));
  constexpr bool may_be_absent = requires(T value) { value.has_value(); };  // such a value has no default
  if constexpr (!may_be_absent && requires { to_json(Owner().*field.value); })
    if (!field.required) out["default"] = Json::parse(print_json(to_json(Owner().*field.value)));
  out["description"] = sentence(field.help + choices(static_cast<const T*>(nullptr)), field.unit);
  return out;
}

/// Makes the properties of an object anew: those that are no fields stay as they are, and there are no others.
template <class Fields>
void renew(Json& object, const Fields& fields, const std::vector<std::string>& no_fields = {}) {
  Json& properties = object["properties"];
  std::set<std::string> names(no_fields.begin(), no_fields.end()), required;
  for (const std::string& name : names) CHECK_MESSAGE(properties.contains(name), name);
  for (const std::string name : object.value("required", Json::array()))
    if (names.contains(name)) required.insert(name);
  const auto add = [&](const auto& field) {
    names.insert(field.name);
    if (field.required) required.insert(field.name);
    properties[field.name] = property(field);
  };
  std::apply([&](const auto&... field) { (add(field), ...); }, fields);
  const Json before = properties;
  for (const auto& [name, _] : before.items())
    if (!names.contains(name)) properties.erase(name);
  if (std::set<std::string>(object.value("required", Json::array())) != required && !required.empty())
    object["required"] = required;
  object["additionalProperties"] = false;
}

/// A kind of a variant, known by its "type".
template <class Kind>
void renew_kind(Json& object, std::vector<std::string> no_fields = {}) {
  if constexpr (requires { Kind::colour_name; })
    if (Kind::colour_name) no_fields.emplace_back(Kind::colour_name);
  if constexpr (requires { Kind::file; }) no_fields.emplace_back("file");
  no_fields.insert(no_fields.begin(), "type");
  object["description"] = Kind::about;
  object["properties"]["type"] = {{"const", Kind::type}};
  if constexpr (requires { fields(static_cast<const Kind*>(nullptr)); })
    renew(object, fields_of<Kind>(), no_fields);
  else
    renew(object, std::tuple(), no_fields);
}

/// The kinds of a variant, in its order, after `first` others.
template <class... Kinds>
void renew_kinds(Json& schema, const std::variant<Kinds...>*, const std::vector<std::string>& no_fields = {},
                 std::size_t first = 0) {
  (renew_kind<Kinds>(schema["oneOf"][first++], no_fields), ...);
}
template <class... Skies>
void renew_skies(Json& schema, const std::variant<Vec3d, Skies...>*) {
  renew_kinds(schema, static_cast<const std::variant<Skies...>*>(nullptr), {}, 1);
}
template <class... Moves>
void renew_moves(Json& schema, const std::variant<Moves...>*) {
  std::size_t k = 0;
  (renew(schema["items"]["oneOf"][k++], fields_of<Moves>()), ...);
}

Json renewed(Json schema) {
  Json& parts = schema["$defs"];
  renew(parts["image"], image_fields());
  renew(parts["camera"], fields_of<Camera>(), {"shutter"});
  renew(parts["render"], fields_of<RenderSettings>());
  renew(parts["display"], fields_of<Display>());
  renew(parts["animation"], fields_of<Animation>(), {"keys"});
  renew_skies(parts["background"], static_cast<const Background*>(nullptr));
  renew_kinds(parts["texture"], static_cast<const TextureKinds<double>*>(nullptr));
  renew_kinds(parts["material"], static_cast<const MaterialKinds<double>*>(nullptr));
  renew_kinds(parts["boundary"], static_cast<const decltype(Volume::boundary)*>(nullptr), {"transform"});
  renew_moves(parts["transform"], static_cast<const Transform::value_type*>(nullptr));
  using Shapes = decltype(Solid3d::shape);
  renew_kinds(parts["object"], static_cast<const Shapes*>(nullptr), {"name", "material", "transform"});
  renew_kind<Medium<>>(parts["object"]["oneOf"][std::variant_size_v<Shapes>],
                       {"name", "boundary", "albedo", "transform"});
  return schema;
}

}  // namespace

TEST_CASE("schema: the file for editors is what the lists of fields say") {
  const Json kept = Json::parse(std::ifstream(file)), made = renewed(kept);
  if (is_set("TYNDALL_WRITE_SCHEMA")) std::ofstream(file) << print_json(parse_json(made.dump()).root);
  const nlohmann::json differences = nlohmann::json::diff(kept, made);
  CHECK_MESSAGE(differences.empty(), differences.dump(1));
}

// Facts of the format, written by hand: they hold the lists themselves to what users rely on.
TEST_CASE("schema: what users rely on") {
  const Json parts = Json::parse(std::ifstream(file)).at("$defs");
  const auto kind = [](const Json& one_of, const std::string& type) {
    for (const Json& each : one_of.at("oneOf"))
      if (each.contains("properties") && each["properties"].value("type", Json()).value("const", "") == type)
        return each;
    return Json();
  };
  const Json render = parts["render"]["properties"];
  const std::set<std::string> integrators = render["integrator"]["enum"];
  for (const char* name : {"path", "nee", "mis"}) CHECK(integrators.count(name) == 1);
  CHECK(render["integrator"]["default"] == "mis");
  CHECK(render["max_depth"]["default"] == 1000);
  CHECK(render["max_depth"]["minimum"] == 0);
  CHECK_FALSE(render["spp"].contains("default"));
  CHECK(render["adaptive"]["type"] == "boolean");
  CHECK(render["adaptive"]["default"] == false);
  CHECK(parts["display"]["properties"]["exposure"]["maximum"] == 100);
  CHECK(parts["camera"]["properties"]["vfov"]["exclusiveMaximum"] == 180);
  CHECK(parts["camera"]["properties"].contains("shutter"));
  const Json sphere = kind(parts["object"], "sphere"), metal = kind(parts["material"], "metal");
  CHECK(sphere["required"] == Json{"type", "material", "center", "radius"});
  CHECK(sphere["additionalProperties"] == false);
  CHECK(sphere["properties"]["radius"]["not"]["const"] == 0);
  CHECK(metal["required"] == Json{"type", "albedo"});
  CHECK(metal["properties"]["fuzz"]["maximum"] == 1);
  CHECK(kind(parts["material"], "dielectric")["properties"].size() == 2);
  CHECK(kind(parts["texture"], "image")["required"] == Json{"type", "file"});
  CHECK(kind(parts["object"], "medium")["properties"]["g"]["exclusiveMinimum"] == -1);
  CHECK(kind(parts["object"], "group")["required"] == Json{"type", "objects"});
  CHECK(parts["boundary"]["oneOf"].size() == 2);
}

}  // namespace tyndall::test::schema_test
