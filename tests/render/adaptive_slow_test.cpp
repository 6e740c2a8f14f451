#include "tests/support/pictures.h"
#include "tests/support/statistics.h"

#include <cmath>

namespace tyndall::test::adaptive_slow_test {

TEST_CASE("adaptive: the mean over a picture is that of even samples, to 0.01 %, where counts differ most") {
  for (const char* name : {"showroom", "wide-view", "stress-medium-in-glass"}) {
    CAPTURE(name);
    Scene scene = small_scene(name, 48, 36, 64);
    std::vector<double> ratios;
    for (std::uint32_t seed = 0; seed < 600; ++seed) {
      double mean[2] = {};
      for (const bool adaptive : {false, true}) {
        scene.render.seed = seed;
        const RenderOptions options{.spp = 64, .adaptive = adaptive};
        for (const float value : resolve(render(compile(scene), options).film))
          mean[adaptive ? 1 : 0] += static_cast<double>(value);
      }
      ratios.push_back(mean[1] / mean[0] - 1);
    }
    const Estimate bias = estimate(ratios);
    MESSAGE(name << ": " << bias.mean << " +- " << bias.error);
    CHECK(bias.error < 4e-5);  // or the measurement would be too rough to find a fault
    CHECK(std::abs(bias.mean) < 1e-4);
  }
}

}  // namespace tyndall::test::adaptive_slow_test
