#include "app/check/check.h"
#include "tests/app/check/verdicts.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>

/// Many right pictures, none of which may be accused, and the planted mistakes.
namespace tyndall::test::explain_slow_test {

namespace {

constexpr std::uint32_t spp = 512;  // of references

Scene scene_of(const std::string& name) {
  const Scene scene = load_scene(name).scene;
  const bool square = scene.width == scene.height;
  return scene_for_book(name, square ? 150 : 200, square ? 150 : 112);
}

/// A right picture.
struct Right {
  std::string scene;
  int width = 0;
  BookProgramPlan plan;
};

/// The pictures of a trial, by numbers from 0 on. Values from `low` to `high`, small ones as likely as large ones.
Right right_picture(int number, std::pair<double, double> widths, std::pair<double, double> samples) {
  const char* scenes[] = {"metal-spheres", "cornell-box",       "glass-spheres", "cornell-smoke",   "hollow-glass",
                          "quads",         "checkered-spheres", "defocus",       "stress-thin-fog", "stress-motion",
                          "wide-view",     "tele-view",         "cover"};
  std::mt19937_64 random(static_cast<std::uint64_t>(number));
  const auto between = [&random](std::pair<double, double> range) {
    const double part = static_cast<double>(random() >> 11) * 0x1p-53;
    return static_cast<int>(std::lround(range.first * std::pow(range.second / range.first, part)));
  };
  Right right{scenes[number % 13], between(widths), {}};
  right.plan.spp = between(samples), right.plan.edition = 1 + static_cast<int>(random() % 4);
  right.plan.srgb = random() % 4 == 0, right.plan.seed = random() % 1000000;
  right.plan.generator = static_cast<Generator>(number / 13 % 4);
  return right;
}
Right small_picture(int number) { return right_picture(number, {32, 160}, {1, 16}); }
/// Of at most 12 million samples, of all scenes but the last, which has many objects.
Right large_picture(int number) {
  Right right = right_picture(1300 + 13 * (number / 12) + number % 12, {100, 800}, {16, 1000});
  right.plan.spp = std::min(right.plan.spp, static_cast<int>(1.2e7 / right.width / right.width));
  return right;
}

/// Judges so many right pictures, none of which may be accused. Of how many it is told that they agree.
int count_told(int pictures, Right (*picture)(int)) {
  int told = 0;
  for (int number = 0; number < pictures; ++number) {
    const Right right = picture(number);
    const Scene whole = load_scene(right.scene).scene;
    const Scene scene = scene_for_book(right.scene, right.width, right.width * whole.height / whole.width);
    const double enough = 3e7 / (scene.width * scene.height);
    const Findings verdict = verdict_of(scene, right.plan, static_cast<std::uint32_t>(std::clamp(enough, 64.0, 256.0)));
    INFO("picture " << number << ": " << right.scene << ", " << right.width << " columns, " << right.plan.spp
                    << " samples, edition " << right.plan.edition << "\n"
                    << verdict_text(verdict));
    CHECK((verdict.agrees || verdict.too_few));
    told += verdict.agrees ? 1 : 0;
  }
  MESSAGE(pictures << " right pictures: " << told << " agree");
  return told;
}

}  // namespace

TEST_CASE("check: thirty right pictures are not accused") {
  struct Picture {
    int spp, edition;
    bool srgb = false;
  };
  const std::pair<const char*, std::vector<Picture>> rows[] = {
      {"metal-spheres", {{10, 4}, {100, 1}, {500, 3, true}}},
      {"glass-spheres", {{10, 3}, {200, 4}}},
      {"hollow-glass", {{50, 4}, {400, 3}}},
      {"hollow-glass-index", {{100, 4, true}}},
      {"wide-view", {{30, 2}}},
      {"tele-view", {{60, 4}}},
      {"defocus", {{100, 4}, {20, 3, true}}},
      {"cover", {{10, 4}, {30, 3}}},
      {"bouncing-spheres", {{20, 4}}},
      {"checkered-spheres", {{50, 4}}},
      {"quads", {{100, 4}, {20, 3, true}}},
      {"cornell-box", {{10, 4}, {64, 3}, {300, 4, true}}},
      {"cornell-smoke", {{20, 4}, {200, 3}}},
      {"cornell-box", {{30, 1}}},
      {"glass-spheres", {{500, 1}}},
      {"checkered-spheres", {{10, 3, true}}},
      {"stress-motion", {{50, 4}}},
      {"stress-bulb", {{100, 4}}},
      {"stress-thin-fog", {{50, 4}}},
      {"bouncing-spheres", {{60, 3}}},
  };
  int count = 0;
  for (const auto& [scene, pictures] : rows)
    for (const auto& [samples, edition, srgb] : pictures) {
      const BookProgramPlan plan{samples, edition, srgb, Plant::none, static_cast<std::uint64_t>(++count)};
      const Findings verdict = verdict_of(scene_of(scene), plan, spp);
      INFO(scene << ", " << samples << " samples, edition " << edition << "\n" << verdict_text(verdict));
      // Only one scene's light is too rare for any answer.
      CHECK(name_of(verdict) == (std::string(scene) == "stress-bulb" ? "unknown" : "agrees"));
    }
}

TEST_CASE("check: of 44 planted mistakes all but one are found, most are named, and none gets a wrong name") {
  struct Row {
    Plant plant;
    std::string name;
    std::vector<const char*> scenes;
  };
  const Row rows[] = {
      {Plant::no_gamma, "no-gamma", {"cover", "cornell-box"}},
      {Plant::upside_down, "upside-down", {"cover", "glass-spheres"}},
      {Plant::mirrored, "mirrored", {"glass-spheres", "quads"}},
      {Plant::red_blue, "red-blue", {"cornell-box", "metal-spheres"}},
      {Plant::short_paths, "depth-2", {"hollow-glass", "cornell-box", "glass-spheres"}},
      {Plant::schlick_is_one, "schlick-always-1", {"glass-spheres", "cover"}},
      {Plant::hemisphere, "hemisphere", {"metal-spheres", "cornell-box", "cover"}},
      {Plant::long_mirror, "long-mirror", {"metal-spheres", "tele-view"}},
      {Plant::positive_radius, "positive-radius", {"hollow-glass"}},
      {Plant::sky_brackets, "sky-brackets", {"cover", "metal-spheres", "wide-view"}},
      {Plant::lost_time, "time-lost", {"bouncing-spheres"}},
      {Plant::no_defocus, "no-defocus", {"defocus", "defocus"}},
      {Plant::acne, "shadow-acne", {"metal-spheres", "cornell-box", "cover"}},
      {Plant::inverted_index, "inverted-index", {"glass-spheres", "cover"}},
      {Plant::by_value, "matt-black", {"cover", "metal-spheres"}},
      {Plant::wrong_cross, "cross-z", {"tele-view"}},
      {Plant::own_sky, "unexplained", {"cover", "glass-spheres"}},
      {Plant::twice, "unexplained", {"cornell-box", "metal-spheres", "cover", "quads"}},
      {Plant::cut_samples, "unexplained", {"cornell-box"}},
      {Plant::bright_lights, "unexplained", {"metal-spheres"}},
      {Plant::cut_samples, "unexplained", {"cornell-smoke"}},
      {Plant::bright_lights, "unexplained", {"cornell-box", "glass-spheres"}},
  };
  int named = 0, found = 0, count = 0;
  for (const Row& row : rows)
    for (const char* scene : row.scenes) {
      const BookProgramPlan plan{60, 4, false, row.plant, static_cast<std::uint64_t>(++count)};
      const Findings verdict = verdict_of(scene_of(scene), plan, spp);
      const std::string name = name_of(verdict);
      MESSAGE(row.name << " in " << scene << ": " << name << "\n" << verdict_text(verdict));
      const bool right = name.starts_with(row.name);  // "time-lost" may be found as "time-lost-matt"
      CHECK((right || name == "unexplained" || name == "agrees"));
      named += right && name != "unexplained" ? 1 : 0;
      found += name == "agrees" ? 0 : 1;
    }
  CHECK(named == 31);
  CHECK(found == 43);  // a brighter lamp in a dark room looks like another curve
}

TEST_CASE("check: right pictures of few samples by four generators are not accused") {
  CHECK(count_told(96, small_picture) > 80);
}

// A quarter of an hour: slow_tests -tc="*a thousand*" --no-skip
TEST_CASE("check: a thousand right pictures by four generators are not accused" * doctest::skip()) {
  SUBCASE("900 of at most 160 columns and 16 samples") { CHECK(count_told(900, small_picture) > 750); }
  SUBCASE("100 of up to 800 columns and 1,000 samples") { CHECK(count_told(100, large_picture) == 100); }
}

}  // namespace tyndall::test::explain_slow_test
