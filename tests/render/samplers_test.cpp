#include "tests/support/known_answers.h"
#include "tests/support/probe.h"

#include <doctest/doctest.h>

/// All pixels of a probe show the same thing, each with random numbers of its own. So the means of 1024 pixels tell a
/// sampler's mean and variance.
namespace tyndall::test::samplers_test {

TEST_CASE("samplers: over a thousand randomisations neither is off, and sobol scatters no more than random") {
  ZScores scores;
  for (const char* name : {"sky/floor", "square-lamp/corner-h1", "fog-ball/depth2-albedo0.9-b0.6",
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

}  // namespace tyndall::test::samplers_test
