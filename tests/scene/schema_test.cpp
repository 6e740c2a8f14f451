#include "core/system/process.h"
#include "tests/scene/files.h"
#include "tests/scene/scene_schema.h"
#include "tests/support/paths.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <set>
#include <string>

namespace tyndall::test::schema_test {
using Json = nlohmann::json;

TEST_CASE("schema: the file for editors is what the lists of fields say") {
  const std::filesystem::path file = assets_folder() / "scene.schema.json";
  const std::string made = test::scene_schema();
  if (is_set("TYNDALL_WRITE_SCHEMA")) std::ofstream(file, std::ios::binary) << made;
  CHECK_MESSAGE(test::read_text(file) == made, "tests/scene/scene_schema.h says how to write it anew");
}

// Facts of the format, written by hand: they hold the lists themselves to what users rely on.
TEST_CASE("schema: what users rely on") {
  const Json parts = Json::parse(test::scene_schema()).at("$defs");
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
