#include "app/cli/verify.h"

#include "app/text/values.h"
#include "core/scene/load.h"
#include "tests/support/paths.h"

#include <doctest/doctest.h>

#include <fstream>
#include <set>

namespace tyndall::test::verify_cases_test {

namespace {

std::vector<VerifyCase> read(const std::string& text) {
  const std::filesystem::path file = scratch_folder() / "verify_cases_test.json";
  std::ofstream(file) << text;
  return read_verify_cases(file);
}

/// A table of one group with these cases.
std::string table(const std::string& cases) {
  return R"({ "groups": [{ "name": "plate", "scene": "plate.json", "source": "Fresnel",
              "set": { "/image/width": 8 }, "cases": [)" +
         cases + "] }] }";
}

std::string refusal(const std::string& text) {
  try {
    read(text);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "nothing refused";
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::vector<std::string> names_of(const std::vector<VerifyCase>& cases) {
  std::vector<std::string> names;
  for (const VerifyCase& c : cases) names.push_back(c.name);
  return names;
}

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("cases: a group's overrides and source, then the case's own") {
  const auto cases = read(table(R"({ "name": "a", "expected": 0.5 },
      { "name": "b", "set": { "/camera": { "vfov": 20 } }, "expected": 0.25, "source": "Snell" })"));
  REQUIRE(cases.size() == 2);
  CHECK(names_of(cases) == Names{"plate/a", "plate/b"});
  CHECK(cases[0].scene.filename() == "plate.json");
  CHECK(cases[0].source == "Fresnel");
  CHECK(cases[0].expected == 0.5);
  CHECK(cases[0].overrides.size() == 1);
  CHECK(cases[0].overrides[0].pointer == "/image/width");
  CHECK(cases[1].source == "Snell");
  REQUIRE(cases[1].overrides.size() == 2);
  CHECK(cases[1].overrides[1].pointer == "/camera");
  CHECK(has(cases[1].overrides[1].value, "20"));
  CHECK_FALSE(cases[1].requires_light_sampling);
}

TEST_CASE("cases: what is wrong with a table is one line that says where") {
  CHECK(has(refusal(table(R"({ "name": "a" })")), "/groups/0/cases/0: found no \"expected\", expected a number"));
  CHECK(has(refusal(table(R"({ "name": "a", "expected": "much" })")), "/groups/0/cases/0/expected: found \"much\""));
  CHECK(has(refusal(table(R"({ "name": "a", "expected": 1, "sett": {} })")), "did you mean \"set\"?"));
  CHECK(has(refusal(table(R"({ "name": "a", "expected": 1, "set": { "vfov": 1 } })")), "found no JSON pointer"));
  CHECK(has(refusal(table(R"({ "name": "a", "expected": 1 }, { "name": "a", "expected": 1 })")), "\"plate/a\" twice"));
  CHECK(has(refusal(R"({ "groups": 3 })"), "/groups: found 3"));
  CHECK(has(refusal(R"({ "groups": [{ "name": "x" }] })"), "/groups/0: found no \"scene\""));
  CHECK(has(refusal("{"), "verify_cases_test.json: line 1"));
  CHECK_THROWS_AS(read_verify_cases("/nowhere/cases.json"), SceneError);
}

TEST_CASE("cases: chosen by the beginnings of their names, in the table's order") {
  const auto cases = read(table(R"({ "name": "thin-a", "expected": 1 }, { "name": "thick", "expected": 1 },
                                   { "name": "thin-b", "expected": 1 })"));
  CHECK(chosen_cases(cases, {}).size() == 3);
  CHECK(names_of(chosen_cases(cases, {"plate/thin"})) == Names{"plate/thin-a", "plate/thin-b"});
  CHECK(names_of(chosen_cases(cases, {"plate/thin-b", "plate/thick"})) == Names{"plate/thick", "plate/thin-b"});
  CHECK_THROWS_WITH_AS(chosen_cases(cases, {"plate/thikc"}),
                       "found no case \"plate/thikc\" (did you mean \"plate/thick\"?), expected the beginning of a "
                       "case's name",
                       UsageError);
}

TEST_CASE("cases: every one of the table that comes with Tyndall has a scene that can be read") {
  const auto cases = read_verify_cases(assets_folder() / "verify" / "cases.json");
  CHECK(cases.size() > 300);
  std::set<std::filesystem::path> used;
  for (const VerifyCase& c : cases) {
    CAPTURE(c.name);
    CHECK_NOTHROW(load_scene(c.scene.string(), c.overrides));
    CHECK(c.expected > 0);
    CHECK(c.source.size() > 5);
    used.insert(c.scene.filename());
  }
  for (const auto& entry : std::filesystem::directory_iterator(assets_folder() / "verify")) {
    CAPTURE(entry.path().string());
    if (entry.path().filename() == "cases.json" || entry.path().extension() == ".hdr") continue;  // no scenes
    CHECK(used.count(entry.path().filename()) == 1);
    CHECK_NOTHROW(load_scene(entry.path().string()));
  }
}

}  // namespace tyndall::test::verify_cases_test
