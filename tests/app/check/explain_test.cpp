#include "app/check/check.h"
#include "app/check/statistics.h"
#include "tests/app/check/verdicts.h"
#include "tests/support/thorough.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <limits>
#include <random>

namespace tyndall::test::explain_test {

namespace {

/// Samples of one pixel, grey.
std::vector<BookSample> grey(const std::vector<float>& values) {
  std::vector<BookSample> samples;
  for (const float v : values) samples.push_back({{v, v, v}, 0});
  return samples;
}

/// A picture of `pixels` x `pixels` of one grey with noise, compared with the grey.
struct NoisyPicture {
  Lattice lattice{64, 64, 1};
  Regions regions = blocks_of(lattice, edge_of_blocks(lattice));
  LatticeLight picture, expected;
  NoisyPicture(unsigned seed, double noise) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0.3, noise);
    for (std::size_t k = 0; k < 3 * lattice.pixels(); ++k) {
      picture.light.push_back(normal(random)), picture.tolerance.push_back(0.004);
      expected.light.push_back(0.3), expected.variance.push_back(0);
    }
  }
  std::vector<CellDifference> differences() const { return differences_of(picture, expected, regions); }
  Misfit misfit() const { return misfit_of(differences()); }
};

}  // namespace

TEST_CASE("check: statistics of samples are their mean, their variance, and what white cuts off of groups") {
  const auto samples = grey({0, 2, 0, 4});
  const SampleStatistics single = statistics_of(samples, 4, {1})[0], pairs = statistics_of(samples, 4, {2})[2];
  CHECK(single.mean == doctest::Approx(1.5));
  CHECK(single.variance == doctest::Approx(11.0 / 3));
  CHECK(single.excess == doctest::Approx((1.0 + 3.0) / 4));
  CHECK(pairs.excess == doctest::Approx((0.0 + 1.0) / 2));  // of the means 1 and 2
  CHECK(single.noise == doctest::Approx(1.0 / 3));          // of 0, 1, 0, 1
  CHECK(single.common == doctest::Approx(1.0));             // of these with 0, 2, 0, 4
  CHECK(pairs.noise == 0);                                  // both are white
  const SampleStatistics light = statistics_of(samples, 4, {2, std::numeric_limits<double>::infinity()})[0];
  CHECK(light.excess == 0);
  CHECK(light.noise == doctest::Approx(0.5));  // of 1 and 2
}

TEST_CASE("check: what white cuts off of many samples is found from the samples of neighbours") {
  std::mt19937 random(5);
  std::bernoulli_distribution hit(0.05);
  constexpr int count = 16, pixels = 4000;
  std::vector<BookSample> samples;
  for (int k = 0; k < count * pixels; ++k) samples.push_back({hit(random) ? Vec3f{10, 10, 10} : Vec3f{}, 0});
  const Regions one{std::vector<int>(pixels, 0), 1};
  double few = 0, many = 0;
  constexpr int trials = 100000, of_many = 128;
  std::binomial_distribution<int> hits_of_few(count, 0.05), hits_of_many(of_many, 0.05);
  for (int k = 0; k < trials; ++k) {
    few += std::max(0.0, hits_of_few(random) * 10.0 / count - 1);
    many += std::max(0.0, hits_of_many(random) * 10.0 / of_many - 1);
  }
  CHECK(excess_ratios(samples, count, of_many, one)[0] == doctest::Approx(many / few).epsilon(0.15));
}

TEST_CASE("check: noise makes no difference, a shift of one block does") {
  for (unsigned seed = 0; seed < 200; ++seed) CHECK(NoisyPicture(seed, 0.1).misfit().different == 0);
  NoisyPicture shifted(1, 0.02);
  for (std::size_t pixel = 0; pixel < shifted.lattice.pixels(); ++pixel)
    if (shifted.regions.of_pixel[pixel] == 10) shifted.picture.light[3 * pixel + 1] += 0.03;
  CHECK(shifted.misfit().different == 1);
  CHECK(amount_of(shifted.differences(), shifted.differences()) > 0);
  for (int& region : shifted.regions.of_pixel)
    if (region == 10) region = -1;
  CHECK(shifted.misfit().different == 0);
  CHECK(shifted.misfit().blocks == shifted.regions.count - 1);
}

TEST_CASE("check: without noise a difference of less than a step of 8 bits is none") {
  NoisyPicture flat(1, 0);
  for (double& value : flat.picture.light) value += 0.003;
  CHECK(flat.misfit().different == 0);
  for (double& value : flat.picture.light) value += 0.003;
  CHECK(flat.misfit().different == flat.misfit().blocks);
}

TEST_CASE("check: where no bright sample happened to be met, the error is that of the known variance") {
  NoisyPicture dark(1, 0);
  for (double& value : dark.expected.light) value += 0.02;
  std::fill(dark.expected.variance.begin(), dark.expected.variance.end(), 0.04);
  CHECK(dark.misfit().different == 0);
  std::fill(dark.expected.variance.begin(), dark.expected.variance.end(), 0);
  CHECK(dark.misfit().different == dark.misfit().blocks);
}

TEST_CASE("check: the fraction of light that has come up to each depth") {
  CHECK(light_by_depth({{{1, 1, 1}, 0}, {{1, 1, 1}, 2}}) == Numbers{0.5, 0.5, 1});
}

TEST_CASE("check: a picture's numbers as each way of reading takes them") {
  PictureNumbers picture{2, 1, {0.5f, 1, 0.25f, 0, 0.75f, 1}};
  const auto light = [&](const Reading& reading) { return read_pixels(picture, {2, 1}, reading).light; };
  CHECK(light({TransferCurve::light}) == Numbers{0.5, 1, 0.25, 0, 0.75, 1});
  CHECK(light({TransferCurve::light, false, true}) == Numbers{0, 0.75, 1, 0.5, 1, 0.25});
  CHECK(light({TransferCurve::light, false, false, true}) == Numbers{0.25, 1, 0.5, 1, 0.75, 0});
  CHECK(light({TransferCurve::gamma2}) == Numbers{0.25, 1, 0.0625, 0, 0.5625, 1});
}

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
