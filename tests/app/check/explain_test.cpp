#include "app/check/check.h"
#include "tests/app/check/verdicts.h"
#include "tests/support/thorough.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

namespace tyndall::test::explain_test {

namespace {

constexpr std::uint32_t spp = 512;  // of references

BookProgramPlan planted(Plant plant, int samples = 40) {
  BookProgramPlan plan;
  plan.plant = plant, plan.spp = samples;
  return plan;
}

}  // namespace

TEST_CASE("check: right pictures of programs of all editions are never accused") {
  const Scene box = scene_for_book("cornell-box", 64, 64), balls = scene_for_book("metal-spheres", 96, 54);
  const int editions[] = {4, 1, 3};
  for (const int edition : tried(editions, 1)) {
    BookProgramPlan plan;
    plan.edition = edition, plan.spp = edition == 3 ? 100 : 20, plan.srgb = edition == 3;
    CAPTURE(edition);
    const Findings of_box = verdict_of(box, plan, spp), of_balls = verdict_of(balls, plan, spp);
    CHECK(name_of(of_box) == "agrees");
    CHECK(name_of(of_balls) == "agrees");
    CHECK(of_box.samples > 0.6 * plan.spp);
    CHECK(of_box.samples < 1.6 * plan.spp);
  }
}

TEST_CASE("check: what editions do otherwise is said, and is no mistake") {
  const Scene glass = scene_for_book("glass-spheres", 128, 72);
  const Findings verdict = verdict_of(glass, planted(Plant::none, 100), spp);
  CHECK(name_of(verdict) == "agrees");
  REQUIRE_FALSE(verdict.choices.empty());
  CHECK(verdict.choices[0].name == "schlick");
  CHECK(verdict.curve == TransferCurve::gamma2);
  const std::string text = verdict_text(verdict);
  CHECK(text.find("agree within the noise") != std::string::npos);
  CHECK(text.find("Schlick's rule") != std::string::npos);
}

TEST_CASE("check: planted mistakes are named") {
  struct Case {
    const char* scene;
    Plant plant;
    const char* name;
  };
  const Case cases[] = {{"metal-spheres", Plant::no_gamma, "no-gamma"},
                        {"glass-spheres", Plant::schlick_is_one, "schlick-always-1"},
                        {"metal-spheres", Plant::upside_down, "upside-down"},
                        {"metal-spheres", Plant::hemisphere, "hemisphere"},
                        {"metal-spheres", Plant::acne, "shadow-acne"},
                        {"glass-spheres", Plant::sky_brackets, "sky-brackets"}};
  for (const Case& c : tried(cases, 2))
    CHECK(name_of(verdict_of(scene_for_book(c.scene, 96, 54), planted(c.plant), spp)) == c.name);
}

TEST_CASE("check: attenuation passed by value is not taken for paths that are too short") {
  const Scene box = scene_for_book("cornell-box", 64, 64);
  const Findings verdict = verdict_of(box, planted(Plant::by_value), spp);
  CHECK(name_of(verdict) == "attenuation-lost");
  CHECK(verdict_text(verdict).find("attenuation is passed by value") != std::string::npos);
}

TEST_CASE("check: pictures of one sample or two are not accused, and of few it is said that they cannot tell") {
  const Scene box = scene_for_book("cornell-box", 48, 48), balls = scene_for_book("metal-spheres", 64, 36);
  for (const int samples : {1, 2}) {
    CAPTURE(samples);
    BookProgramPlan plan = planted(Plant::none, samples);
    plan.generator = Generator::std_rand;
    CHECK(name_of(verdict_of(balls, plan, 64)) == "agrees");
    const Findings verdict = verdict_of(box, plan, 64);
    CHECK((verdict.agrees || verdict.too_few));
    CHECK(verdict_json(verdict)["too_few_samples"] == verdict.too_few);
    if (samples > 1) continue;
    CHECK(verdict.too_few);
    CHECK(verdict_json(verdict)["agrees"].is_null());
    CHECK(verdict_text(verdict).find("too few samples to tell") != std::string::npos);
  }
}

TEST_CASE("check: no mistake is named where there was no time to try them all, and what helps is told") {
  const Scene scene = scene_for_book("metal-spheres", 96, 54);
  const Findings verdict = verdict_of(scene, planted(Plant::short_paths), 64, {5, 8}, [] { return false; });
  CHECK_FALSE(verdict.agrees);
  CHECK_FALSE(verdict.mistake);
  CHECK(verdict.untried > 5);
  CHECK_FALSE(verdict.tried.empty());  // depths need no time
  CHECK(verdict_text(verdict).find("none is named, as the time was up") != std::string::npos);
  CHECK(verdict_text(verdict).find("--time 10\n") != std::string::npos);
  CHECK(verdict_json(verdict)["out_of_time"] == true);
  CHECK(verdict_json(verdict)["explanation"].is_null());
}

TEST_CASE("check: a mistake that nobody knows is not given another's name, and the object is told") {
  const Scene scene = scene_for_book("metal-spheres", 96, 54);
  const Findings verdict = verdict_of(scene, planted(Plant::own_sky), spp);
  CHECK(name_of(verdict) == "unexplained");
  const auto is_sky = [](const ObjectDifference& d) { return d.object.kind == "sky"; };
  CHECK(std::any_of(verdict.objects.begin(), verdict.objects.end(), is_sky));
  CHECK(verdict_text(verdict).find("none of the usual ones explains it") != std::string::npos);
  const auto json = verdict_json(verdict);
  CHECK(json["agrees"] == false);
  CHECK(json["explanation"].is_null());
  CHECK_FALSE(json["objects"].empty());
}

}  // namespace tyndall::test::explain_test
