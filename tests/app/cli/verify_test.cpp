#include "app/cli/verify.h"

#include "app/text/values.h"
#include "core/scene/load.h"
#include "tests/support/paths.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <set>

namespace tyndall::test::verify_test {

namespace {

std::vector<VerifyCase> read(const std::string& text) {
  const std::filesystem::path file = scratch_folder() / "verify_test.json";
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

bool are_named(const std::vector<VerifyCase>& cases, const std::vector<std::string>& names) {
  return std::ranges::equal(cases, names, {}, &VerifyCase::name);
}

Measured measured(double mean, double error, std::uint64_t rejected = 0) {
  return {{mean, error}, {.samples = 1000, .rejected = rejected}};
}

VerifyRow row(const Measured& m, const std::string& name = "plate/a") {
  return judge({{name, "plate.json", {{"/camera", "{ \"vfov\": 20 }\n"}}, 0.5, "Fresnel"}, {}}, m, 1e-3);
}

/// A run whose z-scores are these.
VerifyRun run_of(const std::vector<double>& scores) {
  VerifyRun run;
  for (const double z : scores) run.rows.push_back(row(measured(0.5 + 4e-4 * z, 4e-4)));
  return run;
}

}  // namespace

TEST_CASE("cases: a group's overrides and source, then the case's own") {
  const auto cases = read(table(R"({ "name": "a", "expected": 0.5 },
      { "name": "b", "set": { "/camera": { "vfov": 20 } }, "expected": 0.25, "source": "Snell" })"));
  REQUIRE(are_named(cases, {"plate/a", "plate/b"}));
  CHECK(cases[0].scene.ends_with("/plate.json"));
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
  CHECK(has(refusal("{"), "verify_test.json: line 1"));
  CHECK_THROWS_AS(read_verify_cases("/nowhere/cases.json"), SceneError);
}

TEST_CASE("cases: chosen by the beginnings of their names, in the table's order") {
  const auto cases = read(table(R"({ "name": "thin-a", "expected": 1 }, { "name": "thick", "expected": 1 },
                                   { "name": "thin-b", "expected": 1 })"));
  CHECK(chosen_cases(cases, {}).size() == 3);
  CHECK(are_named(chosen_cases(cases, {"plate/thin"}), {"plate/thin-a", "plate/thin-b"}));
  CHECK(are_named(chosen_cases(cases, {"plate/thin-b", "plate/thick"}), {"plate/thick", "plate/thin-b"}));
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
    CHECK_NOTHROW(load_scene(c.scene, c.overrides));
    CHECK(c.expected > 0);
    CHECK(c.source.size() > 5);
    used.insert(std::filesystem::path(c.scene).filename());
  }
  for (const auto& entry : std::filesystem::directory_iterator(assets_folder() / "verify")) {
    CAPTURE(entry.path().string());
    if (entry.path().filename() == "cases.json" || entry.path().extension() == ".hdr") continue;  // no scenes
    CHECK(used.count(entry.path().filename()) == 1);
    CHECK_NOTHROW(load_scene(entry.path().string()));
  }
}

TEST_CASE("verdicts: four standard errors, no rejected sample, a sharp measurement") {
  CHECK(row(measured(0.5015, 4e-4)).verdict == "ok");
  CHECK(row(measured(0.5017, 4e-4)).verdict == "FAIL");
  CHECK(row(measured(0.4983, 4e-4)).verdict == "FAIL");
  CHECK(row(measured(0.5, 0)).verdict == "ok");
  CHECK(row(measured(0.50001, 0)).verdict == "FAIL");
  CHECK(row(measured(0.5, 4e-4, 1)).verdict == "FAIL");
  CHECK(row(measured(0.5, 6e-4)).verdict == "vague");
  CHECK(row(measured(0.6, 6e-4)).verdict == "FAIL");
  CHECK(row(measured(std::nan(""), 4e-4)).verdict == "FAIL");
}

TEST_CASE("a run passes if all cases do and their z-scores are neither too large nor too small together") {
  CHECK(passed(run_of({0.5, -1, 1.5, 0.1, -0.7, 1, 0.9, -1.2})));
  CHECK_FALSE(passed(run_of({0.5, -1, 1.5, 0.1, -0.7, 1, 0.9, -5})));
  CHECK_FALSE(passed(run_of(std::vector<double>(50, 0.1))));  // each is fine
  CHECK_FALSE(passed(run_of(std::vector<double>(50, 2.0))));
  VerifyRun vague = run_of({0.5, -1});
  vague.rows.push_back(row(measured(0.5, 6e-4)));
  CHECK_FALSE(passed(vague));
  VerifyRun skipped = run_of({0.5, -1});
  skipped.rows.push_back({});
  CHECK(passed(skipped));
}

TEST_CASE("z-scores: only standard errors above the rounding count") {
  VerifyRun run = run_of({1, -1});
  run.rows.push_back(row(measured(0.5, 0)));
  run.rows.push_back({});
  const ZStatistic scores = z_statistic(run.rows);
  CHECK(scores.count == 2);
  CHECK(scores.mean_square == doctest::Approx(1).epsilon(1e-5).scale(0));
}

TEST_CASE("table: expected, from where, measured, error, z, truncated paths, verdict; what was rejected; a summary") {
  VerifyRun run = run_of({1, -1});
  run.rows.push_back(row(measured(0.6, 4e-4, 3), "plate/long-name"));
  run.rows[0].measured.totals.truncated = 77;
  const std::string text = verify_table(run);
  CHECK(has(text, "Fresnel\n  case             expected     measured     error           z truncated   verdict\n"));
  CHECK(has(text, "\n  plate/a          0.5          0.5004       0.0004       1.00        77   ok\n"));
  CHECK(has(text, "FAIL, 3 samples rejected\n"));
  CHECK(has(text, "3 cases, 2 ok, 1 FAIL; 3e+03 samples, 3 rejected"));
  CHECK(has(text, "z-scores of 3 cases: mean square "));
}

TEST_CASE("json: the same for machines") {
  VerifyRun run = run_of({1});
  run.rows.push_back({});
  const auto json = nlohmann::json::parse(verify_json(run));
  CHECK(json["cases"][0]["name"] == "plate/a");
  CHECK(json["cases"][0]["set"]["/camera"]["vfov"] == 20);
  CHECK(json["cases"][0]["z"].get<double>() == doctest::Approx(1).epsilon(1e-5).scale(0));
  CHECK(json["cases"][0]["verdict"] == "ok");
  CHECK(json["cases"][0]["source"] == "Fresnel");
  CHECK(json["cases"][1]["measured"].is_null());
  CHECK(json["cases"][1]["verdict"] == "skipped");
  CHECK(json["passed"] == true);
}

}  // namespace tyndall::test::verify_test
