#include "tests/scene/scene_schema.h"

#include "core/base/choice.h"
#include "core/scene/json_tree.h"
#include "core/scene/place.h"
#include "core/scene/scene.h"

#include <cctype>
#include <cmath>
#include <type_traits>

namespace tyndall::test {
namespace {

JsonValue text(std::string words) { return {std::move(words)}; }
JsonValue reference(const std::string& name) { return text("#/$defs/" + name); }
JsonValue list(std::initializer_list<JsonValue> items) { return {JsonArray(items)}; }
JsonValue object(JsonObject members) { return {std::move(members)}; }

/// "Vertical field of view, full angle (degrees)."
JsonValue sentence(std::string words, const std::string& unit = "") {
  words[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(words[0])));
  return text(words + (unit == "°" ? " (degrees)." : "."));
}

void add_bounds(JsonObject& out, const Valid& valid) {
  if (std::isfinite(valid.low)) out.push_back({valid.low_open ? "exclusiveMinimum" : "minimum", {valid.low}});
  if (std::isfinite(valid.high)) out.push_back({valid.high_open ? "exclusiveMaximum" : "maximum", {valid.high}});
  if (valid.nonzero) out.push_back({"not", object({{"const", {0.0}}})});
}

/// The name of the shared definition that describes a vector with this range.
std::string vector_name(const Valid& valid) {
  if (valid.low == 0) return valid.high == 1 ? "share" : "radiance";
  return "vector";
}

template <class T>
void add_type(JsonObject& out, const Meaning& meaning, const T*) {
  if constexpr (NamedEnum<T>) {
    JsonArray names;
    for (const std::string_view name : names_of<T>()) names.push_back(text(std::string(name)));
    out.push_back({"enum", {std::move(names)}});
  } else if constexpr (std::is_same_v<T, Vec3d>) {
    out.push_back({"$ref", reference(vector_name(meaning.valid))});
  } else {
    const char* name = std::is_same_v<T, bool> ? "boolean" : std::is_same_v<T, double> ? "number" : "integer";
    out.push_back({"type", text(name)});
    add_bounds(out, meaning.valid);
  }
}
template <class T>
void add_type(JsonObject& out, const Meaning& meaning, const std::optional<T>*) {
  add_type(out, meaning, static_cast<const T*>(nullptr));
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
JsonValue property(const Field<Owner, T>& field) {
  JsonObject out;
  add_type(out, meaning_of(field), static_cast<const T*>(nullptr));
  constexpr bool may_be_absent = requires(T value) { value.has_value(); };  // such a value has no default
  if constexpr (!may_be_absent && requires { to_json(Owner().*field.value); })
    if (!field.required) out.push_back({"default", to_json(Owner().*field.value)});
  out.push_back({"description", sentence(field.help + choices(static_cast<const T*>(nullptr)), field.unit)});
  return object(std::move(out));
}

/// The schema of an object with these members and no others.
JsonValue closed(const std::string& about, JsonArray required, JsonObject properties) {
  JsonObject out{{"type", text("object")}};
  if (!about.empty()) out.push_back({"description", text(about)});
  if (!required.empty()) out.push_back({"required", {std::move(required)}});
  out.push_back({"additionalProperties", {false}});
  out.push_back({"properties", object(std::move(properties))});
  return object(std::move(out));
}

/// The same with a list of fields after `properties`.
template <class Fields>
JsonValue with_fields(const std::string& about, const Fields& fields, JsonArray required = {},
                      JsonObject properties = {}) {
  const auto add = [&](const auto& field) {
    if (field.required) required.push_back(text(field.name));
    properties.push_back({field.name, property(field)});
  };
  std::apply([&](const auto&... field) { (add(field), ...); }, fields);
  return closed(about, std::move(required), std::move(properties));
}

/// A kind of a variant, known by its "type".
template <class Kind>
JsonValue kind(JsonArray required = {}, JsonObject properties = {}) {
  required.insert(required.begin(), text("type"));
  properties.insert(properties.begin(), {"type", object({{"const", text(Kind::type)}})});
  return with_fields(Kind::about, fields_of<Kind>(), std::move(required), std::move(properties));
}

JsonValue colour(const std::string& name) {
  const std::string words = name == "radiance" ? "A colour (red, green, blue, each >= 0, linear)"
                                               : "A colour (red, green, blue in [0, 1], linear)";
  return object({{"description", text(words + " or the name of a texture.")},
                 {"oneOf", list({object({{"$ref", reference(name == "radiance" ? name : "share")}}),
                                 object({{"type", text("string")}})})}});
}

template <class... Kinds>
JsonValue materials(const std::variant<Kinds...>*) {
  const auto one = []<class Kind>(const Kind*) {
    if constexpr (Kind::colour_name != nullptr)
      return kind<Kind>({text(Kind::colour_name)}, {{Kind::colour_name, colour(Kind::colour_name)}});
    else
      return kind<Kind>();
  };
  return object({{"oneOf", list({one(static_cast<const Kinds*>(nullptr))...})}});
}

template <class... Kinds>
JsonValue textures(const std::variant<Kinds...>*) {
  const auto one = []<class Kind>(const Kind*) {
    if constexpr (std::is_same_v<Kind, Image>)
      return closed(Image::about, {text("type"), text("file")},
                    {{"type", object({{"const", text(Image::type)}})},
                     {"file", object({{"type", text("string")},
                                      {"minLength", {1.0}},
                                      {"description", text("Path of an image of 8 or 16 bits (PNG, PPM, JPEG, BMP, "
                                                           "TGA), relative to the scene file.")}})}});
    else
      return kind<Kind>();
  };
  return object({{"oneOf", list({one(static_cast<const Kinds*>(nullptr))...})}});
}

template <class Sky>
JsonValue sky() {
  if constexpr (std::is_same_v<Sky, SkyPicture>)
    return kind<Sky>({text("file")},
                     {{"file", object({{"type", text("string")},
                                       {"minLength", {1.0}},
                                       {"description", text("Path of a picture in floating point (HDR, EXR, PFM), "
                                                            "relative to the scene file.")}})}});
  else
    return kind<Sky>();
}

template <class... Skies>
JsonValue background(const std::variant<Vec3d, Skies...>*) {
  const char* about = "Radiance of rays that hit nothing: a colour, a rule for the direction, or a picture.";
  return object(
      {{"description", text(about)}, {"oneOf", list({object({{"$ref", reference("radiance")}}), sky<Skies>()...})}});
}

template <class... Moves>
JsonValue transform(const std::variant<Moves...>*) {
  return object({{"type", text("array")},
                 {"description", text("Moves, applied in order; then those of the enclosing groups, from inside out.")},
                 {"items", object({{"oneOf", list({with_fields("", fields_of<Moves>())...})}})}});
}

const JsonMember name_member{"name", object({{"$ref", reference("name")}})};
const JsonMember transform_member{"transform", object({{"$ref", reference("transform")}})};

template <class... Shapes>
JsonArray solids(const std::variant<Shapes...>*) {
  const JsonMember material{"material", object({{"$ref", reference("material_name")}})};
  return {kind<Shapes>({text("material")}, {name_member, material, transform_member})...};
}

JsonValue objects() {
  JsonArray kinds = solids(static_cast<const decltype(Solid3d::shape)*>(nullptr));
  kinds.push_back(
      kind<Medium<>>({text("boundary"), text("albedo")}, {name_member,
                                                          {"boundary", object({{"$ref", reference("boundary")}})},
                                                          {"albedo", colour("albedo")},
                                                          transform_member}));
  kinds.push_back(closed("Objects that move together.", {text("type"), text("objects")},
                         {name_member,
                          {"type", object({{"const", text("group")}})},
                          transform_member,
                          {"objects", object({{"$ref", reference("objects")}})}}));
  return object({{"oneOf", {std::move(kinds)}}});
}

template <class... Shapes>
JsonValue boundaries(const std::variant<Shapes...>*) {
  return object({{"description", text("Closed, convex and at rest: no center_end, a radius > 0, no material.")},
                 {"oneOf", list({kind<Shapes>({}, {transform_member})...})}});
}

JsonValue camera() {
  JsonValue out = with_fields("A camera with a thin lens; right-handed.", fields_of<Camera>());
  JsonObject& properties = std::get<JsonObject>(std::get<JsonObject>(out.value).back().value.value);
  const char* about =
      "Times at which the shutter opens and closes, the first not after the second. Spheres move from "
      "center to center_end while time runs from 0 to 1.";
  properties.push_back({"shutter", object({{"type", text("array")},
                                           {"default", list({{0.0}, {0.0}})},
                                           {"items", object({{"type", text("number")}})},
                                           {"minItems", {2.0}},
                                           {"maxItems", {2.0}},
                                           {"description", text(about)}})});
  return out;
}

JsonValue three_numbers(const std::string& about, const Valid& valid) {
  JsonObject item{{"type", text("number")}};
  add_bounds(item, valid);
  return object({{"type", text("array")},
                 {"description", text(about)},
                 {"items", object(std::move(item))},
                 {"minItems", {3.0}},
                 {"maxItems", {3.0}}});
}

JsonValue named_things(const std::string& about, const std::string& definition) {
  return object({{"type", text("object")},
                 {"description", text(about)},
                 {"additionalProperties", object({{"$ref", reference(definition)}})}});
}

JsonValue animation() {
  JsonValue out =
      with_fields("A film: what tyndall animate renders. Other commands ignore it.", fields_of<Animation>());
  JsonObject& properties = std::get<JsonObject>(std::get<JsonObject>(out.value).back().value.value);
  const JsonValue number = object({{"type", text("number")}});
  const JsonValue numbers = object({{"type", text("array")}, {"items", number}, {"minItems", {2.0}}});
  const JsonValue keys = object({{"type", text("object")},
                                 {"minProperties", {1.0}},
                                 {"propertyNames", object({{"pattern", text("^(0|[1-9][0-9]*)$")}})},
                                 {"additionalProperties", object({{"oneOf", list({number, numbers})}})}});
  properties.push_back(
      {"keys",
       object({{"type", text("object")},
               {"description", text("Values at frames, which count from 0, by JSON pointer: \"/camera/vfov\": { \"0\": "
                                    "40, \"119\": 30 }.")},
               {"propertyNames", object({{"pattern", text("^/")}})},
               {"additionalProperties", keys}})});
  return out;
}

JsonValue definitions() {
  const char* size = "Size of the picture in pixels. Pixel (0, 0) is top left.";
  return object({{"vector", three_numbers("Three numbers: x, y, z.", any_number())},
                 {"share", three_numbers("Red, green, blue, each in [0, 1], linear.", between(0, 1))},
                 {"radiance", three_numbers("Radiance: red, green, blue, each >= 0, linear.", at_least(0))},
                 {"name", object({{"type", text("string")}, {"description", text("What the object is called.")}})},
                 {"material_name", object({{"type", text("string")}, {"description", text("Name of a material.")}})},
                 {"image", with_fields(size, image_fields())},
                 {"camera", camera()},
                 {"background", background(static_cast<const Background*>(nullptr))},
                 {"render", with_fields("How the picture is computed. Options of the command line take precedence.",
                                        fields_of<RenderSettings>())},
                 {"display", with_fields("How radiance becomes 8-bit colours in the window and in PNG and PPM files.",
                                         fields_of<Display>())},
                 {"animation", animation()},
                 {"texture", textures(static_cast<const TextureKinds<double>*>(nullptr))},
                 {"material", materials(static_cast<const MaterialKinds<double>*>(nullptr))},
                 {"transform", transform(static_cast<const Transform::value_type*>(nullptr))},
                 {"objects", object({{"type", text("array")},
                                     {"description", text("What is in the scene.")},
                                     {"items", object({{"$ref", reference("object")}})}})},
                 {"object", objects()},
                 {"boundary", boundaries(static_cast<const decltype(Volume::boundary)*>(nullptr))}});
}

}  // namespace

std::string scene_schema() {
  const char* about =
      "A scene for the path tracer Tyndall. Lengths are in scene units, angles in degrees, radiance is "
      "linear RGB (Rec. 709). Comments (// and /* */) are allowed in scene files.";
  JsonObject properties{
      {"tyndall", object({{"const", {1.0}}, {"description", text("Version of the format.")}})},
      {"name", object({{"type", text("string")}, {"description", text("What the scene is called.")}})}};
  for (const char* part : {"image", "camera", "background", "render", "display", "animation"})
    properties.push_back({part, object({{"$ref", reference(part)}})});
  properties.push_back(
      {"textures", named_things("Textures by name; materials and media use them as albedo.", "texture")});
  properties.push_back({"materials", named_things("Materials by name; objects use them.", "material")});
  properties.push_back({"objects", object({{"$ref", reference("objects")}})});
  JsonObject root{{"$schema", text("https://json-schema.org/draft/2020-12/schema")}, {"title", text("Tyndall scene")}};
  JsonObject scene = std::get<JsonObject>(closed(about, {text("tyndall")}, std::move(properties)).value);
  for (JsonMember& member : scene) root.push_back(std::move(member));
  root.push_back({"$defs", definitions()});
  return print_json({std::move(root)});
}

}  // namespace tyndall::test
