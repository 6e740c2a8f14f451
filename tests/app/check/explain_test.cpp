#include "app/check/report.h"
#include "tests/app/check/verdicts.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

namespace tyndall::test::explain_test {

namespace {

constexpr double seconds = 0.5;

BookProgramPlan planted(Plant plant, int spp = 40) {
  BookProgramPlan plan;
  plan.plant = plant, plan.spp = spp;
  return plan;
}

bool has_choice(const Findings& verdict, const std::string& name) {
  for (const Explanation& choice : verdict.choices)
    if (choice.name == name) return true;
  return false;
}

}  // namespace

TEST_CASE("check: right pictures of programs of all editions are never accused") {
  const Scene box = scene_for_book("cornell-box", 64, 64), balls = scene_for_book("metal-spheres", 96, 54);
  for (const int edition : {1, 3, 4}) {
    BookProgramPlan plan;
    plan.edition = edition, plan.spp = edition == 3 ? 100 : 20, plan.srgb = edition == 3;
    CAPTURE(edition);
    const Findings of_box = verdict_of(box, plan, seconds), of_balls = verdict_of(balls, plan, seconds);
    CHECK(name_of(of_box) == "agrees");
    CHECK(name_of(of_balls) == "agrees");
    CHECK(of_box.samples > 0.6 * plan.spp);
    CHECK(of_box.samples < 1.6 * plan.spp);
  }
}

TEST_CASE("check: what editions do otherwise is said, and is no mistake") {
  const Scene glass = scene_for_book("glass-spheres", 128, 72);
  const Findings verdict = verdict_of(glass, planted(Plant::none, 100), seconds);
  CHECK(name_of(verdict) == "agrees");
  CHECK(has_choice(verdict, "schlick"));
  CHECK(verdict.curve == TransferCurve::gamma2);
  const std::string text = verdict_text(verdict);
  CHECK(text.find("agree within the noise") != std::string::npos);
  CHECK(text.find("Schlick's rule") != std::string::npos);
}

TEST_CASE("check: planted mistakes are named") {
  const Scene glass = scene_for_book("glass-spheres", 96, 54), metal = scene_for_book("metal-spheres", 96, 54);
  CHECK(name_of(verdict_of(metal, planted(Plant::no_gamma), seconds)) == "no-gamma");
  CHECK(name_of(verdict_of(metal, planted(Plant::upside_down), seconds)) == "upside-down");
  CHECK(name_of(verdict_of(metal, planted(Plant::hemisphere), seconds)) == "hemisphere");
  CHECK(name_of(verdict_of(glass, planted(Plant::schlick_is_one), seconds)) == "schlick-always-1");
  CHECK(name_of(verdict_of(glass, planted(Plant::sky_brackets), seconds)) == "sky-brackets");
}

TEST_CASE("check: a mistake that nobody knows is not given another's name, and the object is told") {
  const Scene scene = scene_for_book("metal-spheres", 96, 54);
  const Findings verdict = verdict_of(scene, planted(Plant::own_sky), seconds);
  CHECK(name_of(verdict) == "unexplained");
  bool sky = false;
  for (const ObjectDifference& d : verdict.objects)
    sky = sky || verdict.seen.objects[static_cast<std::size_t>(d.object)].kind == "sky";
  CHECK(sky);
  CHECK(verdict_text(verdict).find("none of the usual ones explains it") != std::string::npos);
  const auto json = verdict_json(verdict);
  CHECK(json["agrees"] == false);
  CHECK(json["explanation"].is_null());
  CHECK_FALSE(json["objects"].empty());
}

}  // namespace tyndall::test::explain_test
