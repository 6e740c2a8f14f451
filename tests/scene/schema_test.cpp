#include "tests/scene/files.h"
#include "tests/support/paths.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <set>

using namespace tyndall;
using Json = nlohmann::json;

// assets/scene.schema.json is written by hand for editors; these tests hold it to what the program reads.

namespace {

const Json schema = Json::parse(text_of(assets_folder() / "scene.schema.json"));
using Names = std::set<std::string>;

Names keys(const Json& object) {
  Names names;
  for (const auto& item : object.items()) names.insert(item.key());
  return names;
}
Names listed(const Json& array) { return array.is_array() ? array.get<Names>() : Names{}; }

/// The alternative of a oneOf whose type is `type`.
const Json& kind(const Json& one_of, const std::string& type) {
  static const Json none;
  for (const Json& alternative : one_of.at("oneOf"))
    if (alternative.contains("properties") &&
        alternative["properties"].value("type", Json()).value("const", "") == type)
      return alternative;
  return none;
}

/// Bounds, in whichever of the schema's places they stand: the number itself, or each number of a vector.
const Json& bounds(const Json& property) {
  if (property.contains("$ref")) {
    const std::string name = property["$ref"].get<std::string>().substr(std::string("#/$defs/").size());
    return bounds(schema.at("$defs").at(name));
  }
  return property.contains("items") ? property["items"] : property;
}

void check_bounds(const std::string& name, const Json& json, const Valid& valid) {
  CAPTURE(name);
  const double none = std::numeric_limits<double>::infinity();
  CHECK(json.value("minimum", -none) == (valid.low_open ? -none : valid.low));
  CHECK(json.value("exclusiveMinimum", -none) == (valid.low_open ? valid.low : -none));
  CHECK(json.value("maximum", none) == (valid.high_open ? none : valid.high));
  CHECK(json.value("exclusiveMaximum", none) == (valid.high_open ? valid.high : none));
  CHECK(json.contains("not") == valid.nonzero);
}

/// The schema's object has exactly the fields and `more`, with their ranges, and requires what they require and
/// `required`.
template <class Fields>
void check_object(const std::string& name, const Json& object, const Fields& list, Names more = {},
                  Names required = {}) {
  CAPTURE(name);
  REQUIRE(object.contains("properties"));
  CHECK(object.value("additionalProperties", true) == false);
  const auto one = [&](const auto& field) {
    more.insert(field.name);
    if (field.required) required.insert(field.name);
    if (object["properties"].contains(field.name))
      check_bounds(field.name, bounds(object["properties"][field.name]), field.valid);
  };
  std::apply([&](const auto&... field) { (one(field), ...); }, list);
  CHECK(keys(object["properties"]) == more);
  CHECK(listed(object.value("required", Json())) == required);
}

template <class E>
Names set_of_names() {
  const auto names = names_of<E>();
  return {names.begin(), names.end()};
}

}  // namespace

TEST_CASE("schema: the settings") {
  const Json& parts = schema["$defs"];
  CHECK(keys(schema["properties"]) == Names{"tyndall", "name", "image", "camera", "background", "render", "display",
                                            "textures", "materials", "objects"});
  check_object("image", parts["image"], image_fields());
  check_object("camera", parts["camera"], fields_of<Camera>(), {"shutter"});
  check_object("render", parts["render"], fields_of<RenderSettings>());
  check_object("display", parts["display"], fields_of<Display>());
  check_object("gradient", kind(parts["background"], "gradient"), fields_of<Gradient>(), {"type"}, {"type"});
  check_object("hemispheres", kind(parts["background"], "hemispheres"), fields_of<Hemispheres>(), {"type"}, {"type"});
  CHECK(listed(parts["render"]["properties"]["integrator"]["enum"]) == set_of_names<Integrator>());
  CHECK(listed(parts["render"]["properties"]["sampler"]["enum"]) == set_of_names<SamplerKind>());
  CHECK(listed(parts["render"]["properties"]["fresnel"]["enum"]) == set_of_names<FresnelKind>());
  CHECK(listed(parts["display"]["properties"]["tone_map"]["enum"]) == set_of_names<ToneMap>());
}

TEST_CASE("schema: textures and materials") {
  const Json &texture = schema["$defs"]["texture"], &material = schema["$defs"]["material"];
  CHECK(texture["oneOf"].size() == std::variant_size_v<TextureKinds<double>>);
  check_object("solid", kind(texture, "solid"), fields_of<Solid<>>(), {"type"}, {"type"});
  check_object("checker", kind(texture, "checker"), fields_of<Checker<>>(), {"type"}, {"type"});
  check_object("noise", kind(texture, "noise"), fields_of<Noise<>>(), {"type"}, {"type"});
  check_object("image", kind(texture, "image"), std::tuple{}, {"type", "file"}, {"type", "file"});
  CHECK(listed(kind(texture, "noise")["properties"]["style"]["enum"]) == set_of_names<NoiseStyle>());
  CHECK(material["oneOf"].size() == std::variant_size_v<MaterialKinds<double>>);
  check_object("lambertian", kind(material, "lambertian"), fields_of<Lambertian<>>(), {"type", "albedo"},
               {"type", "albedo"});
  check_object("metal", kind(material, "metal"), fields_of<Metal<>>(), {"type", "albedo"}, {"type", "albedo"});
  check_object("dielectric", kind(material, "dielectric"), fields_of<Dielectric<>>(), {"type"}, {"type"});
  check_object("light", kind(material, "light"), fields_of<Light<>>(), {"type", "radiance"}, {"type", "radiance"});
}

TEST_CASE("schema: objects") {
  const Json &object = schema["$defs"]["object"], &boundary = schema["$defs"]["boundary"];
  const Names all{"name", "type", "material", "transform"}, needed{"type", "material"};
  check_object("sphere", kind(object, "sphere"), fields_of<Sphere<>>(), all, needed);
  check_object("quad", kind(object, "quad"), fields_of<Quad<>>(), all, needed);
  check_object("box", kind(object, "box"), fields_of<Box<>>(), all, needed);
  check_object("medium", kind(object, "medium"), fields_of<Medium<>>(),
               {"name", "type", "boundary", "albedo", "transform"}, {"type", "boundary", "albedo"});
  check_object("group", kind(object, "group"), std::tuple{}, {"name", "type", "transform", "objects"},
               {"type", "objects"});
  check_object("box boundary", kind(boundary, "box"), fields_of<Box<>>(), {"type", "transform"}, {"type"});
  CHECK(keys(kind(boundary, "sphere")["properties"]) == Names{"type", "center", "radius", "transform"});
}
