#include "tests/support/known_answers.h"
#include "tests/support/thorough.h"

#include <doctest/doctest.h>

/// Pictures whose mean is known from elsewhere, by the kernels that draw.
namespace tyndall::test::known_answers_test {

namespace {

/// Of each kind of answer those that are measured soon.
const std::vector<std::string> quick = {
    "furnace/glass",
    "furnace/hollow",
    "fuzzy-plate/fuzz0.3-85deg",
    "plate/reflected-n2.417-80deg",
    "coloured-glass/n1.5-density1-b0.5",
    "smoke-ball/inside-density1",
    "smoke-box",
    "fog-ball/depth1-albedo0.9-b0.6",
    "fog-layer/reflected-depth1-albedo0.9-60deg",
    "square-lamp/corner-h1-",
    "tiled-lamp",
    "ball-lamp/d2-45deg",
    "small-lamp",
    "disk-lamp/ring-aside",
    "triangle-lamp/slanting",
    "two-lamps",
    "lamp-through-smoke",
    "lamp-furnace",
    "ball-on-floor",
    "integrating-sphere",
    "sky",
    "defocus",
    "motion",
    "rainbow",
    "hollow-ball",
    "mirror-ball",
    "ball-on-axis",
    "bulb",
    "plane-mirror",
    "small-lamp-off-a-mirror",
    "pane-on-axis",
    "fuzzy-mirror/fuzz0.01",
    "all-light",
    "two-spheres/reflected-n2.417",
    "fog-in-shell",
};

}  // namespace

TEST_CASE("known answers: every picture has its known mean, and standard errors are right") {
  constexpr double precision = 1e-3;
  VerifyRun run;
  run.precision = precision;
  for (const VerifyCase& answer : thorough() ? known_answers() : chosen_cases(known_answers(), quick)) {
    const Scene scene = scene_of(answer);
    const MeasureOptions options{0, "", precision * std::abs(answer.expected), answer.expected};
    run.rows.push_back(judge({answer, scene.render}, measure_mean(scene, options), precision));
    CAPTURE(answer.name);
    CAPTURE(run.rows.back().z);
    CHECK(run.rows.back().verdict == Verdict::ok);
  }
  CHECK(z_statistic(run.rows).ok());
  CHECK(passed(run));
}

}  // namespace tyndall::test::known_answers_test
