#include "app/cli/verify.h"
#include "tests/support/pictures.h"
#include "tests/support/probe.h"
#include "tests/support/thorough.h"

#include <doctest/doctest.h>

#include <iterator>
#include <sstream>
#include <stdexcept>

/// Pictures whose mean is known from elsewhere, by the kernels that draw: the cases of "tyndall verify".
namespace tyndall::test::known_answers_test {

namespace {

const std::vector<VerifyCase>& known_answers() {
  static const std::vector<VerifyCase> all = read_verify_cases(assets_folder() / "verify" / "cases.json");
  return all;
}

const VerifyCase& known_answer(const std::string& name) {
  for (const VerifyCase& answer : known_answers())
    if (answer.name == name) return answer;
  throw std::invalid_argument("no known answer: " + name);
}

Scene scene_of(const VerifyCase& answer) { return load_scene(answer.scene, answer.overrides).scene; }

/// Of each kind of answer some that are measured soon.
constexpr const char* quick =
    "furnace/glass furnace/hollow fuzzy-plate/fuzz0.3-85deg plate/reflected-n2.417-80deg sky defocus motion rainbow "
    "coloured-glass/n1.5-density1-b0.5 smoke-ball/inside-density1 smoke-box fog-ball/depth1-albedo0.9-b0.6 "
    "fog-layer/reflected-depth1-albedo0.9-60deg square-lamp/corner-h1- tiled-lamp ball-lamp/d2-45deg small-lamp/ "
    "disk-lamp/ring-aside triangle-lamp/slanting two-lamps lamp-through-smoke/density2-mis lamp-furnace ball-on-floor "
    "integrating-sphere/albedo0.8 hollow-ball/through-b0.5 mirror-ball/aside-small-lamp ball-on-axis/glass-far bulb "
    "plane-mirror-small-lamp small-lamp-off-a-mirror pane-on-axis all-light/index-1.5 two-spheres/reflected-n2.417";

}  // namespace

TEST_CASE("known answers: every picture has its known mean, and standard errors are right") {
  constexpr double precision = 1e-3;
  std::istringstream names(quick);
  const std::vector<std::string> some(std::istream_iterator<std::string>(names), {});
  std::vector<VerifyRow> rows;
  for (const VerifyCase& answer : thorough() ? known_answers() : chosen_cases(known_answers(), some)) {
    const Scene scene = scene_of(answer);
    const MeasureOptions options{0, "", precision * std::abs(answer.expected), answer.expected};
    rows.push_back(judge({answer, scene.render}, measure_mean(scene, options), precision));
    CAPTURE(answer.name);
    CAPTURE(rows.back().z);
    CHECK(rows.back().verdict == "ok");
  }
  CHECK(z_statistic(rows).ok());
}

// All pixels of a probe show the same thing, each with random numbers of its own. So the means of 1024 pixels tell a
// sampler's mean and variance.
TEST_CASE("samplers: over a thousand randomisations neither is off, and sobol scatters no more than random") {
  ZScores scores;
  for (const char* name : {"sky/two-colours", "square-lamp/corner-h1", "fog-ball/depth2-albedo0.9-b0.6",
                           "smoke-ball/density1-b0", "motion/y0.3"})
    for (const int spp : {16, 64}) {
      const VerifyCase& answer = known_answer(name);
      Scene scene = scene_of(answer);
      scene.render.seed = static_cast<std::uint32_t>(spp);
      Estimate found[2];
      for (const SamplerKind sampler : {SamplerKind::random, SamplerKind::sobol}) {
        scene.render.sampler = sampler;
        found[sampler == SamplerKind::sobol] = radiance(scene, spp);
        scores.add(name, found[sampler == SamplerKind::sobol], answer.expected, 0.05);
      }
      CHECK(found[1].error <= 1.05 * found[0].error);
    }
}

TEST_CASE("known answers: the means of two of the books' scenes, from long renders of an independent program") {
  if (!thorough()) return;
  struct Known {
    const char* name;
    Vec3d mean;
    double tolerance;
  };
  for (const Known& known :
       {Known{"cornell-box", {0.1775, 0.1585, 0.1443}, 0.001}, Known{"cornell-smoke", {0.5818, 0.5257, 0.4852}, 0.002}})
    for (const Integrator integrator : {Integrator::path, Integrator::nee, Integrator::mis})
      for (const char* isa : {"", "scalar"}) {
        constexpr float Vec3f::*channels[] = {&Vec3f::x, &Vec3f::y, &Vec3f::z};
        const double expected[] = {known.mean.x, known.mean.y, known.mean.z};
        std::vector<double> means[3];
        for (std::uint32_t run = 0; run < 16; ++run) {
          Scene scene = small_scene(known.name, 256, 256, 1);
          scene.render.integrator = integrator, scene.render.seed = run;
          const Film film = film_of(scene, integrator == Integrator::path ? 40 : 16, isa);
          for (int c = 0; c < 3; ++c) means[c].push_back(estimate(channel_of(film, channels[c])).mean);
        }
        for (int c = 0; c < 3; ++c) {
          const Estimate e = estimate(means[c]);
          CAPTURE(known.name);
          CHECK(e.error < known.tolerance / 3);
          CHECK(std::abs(e.mean - expected[c]) < known.tolerance);
        }
      }
}

}  // namespace tyndall::test::known_answers_test
