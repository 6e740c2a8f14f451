#include "tests/support/light_comparison.h"
#include "tests/support/specular_rooms.h"

#include <doctest/doctest.h>

#include <cmath>

/// Every kind of specular path is compared with light tracing. In most rooms this would reveal a weight that is wrong
/// by half a percent; with solid glass, whose caustics have bright edges, one that is wrong by a few percent.
namespace tyndall::test::light_traced_slow_test {

TEST_CASE("specular paths: each kind gives what light tracing gives, in the mean and block by block") {
  constexpr int seeds = 8;
  double squares = 0;
  int count = 0;
  for (const SpecularRoom& room : specular_rooms()) {
    CAPTURE(room.name);
    REQUIRE(compile(room.scene).specular.sphere.size() > 0);
    LightTracing how;
    how.particles = static_cast<std::uint64_t>(room.particles);
    const LightTraced traced = trace_light(room.scene, how);
    const Pictures pictures = rendered(room.scene, room.spp, seeds);
    const Estimate light = mean_of(traced.batches, traced), found = mean_of(pictures, traced);
    const double error = std::hypot(light.error, found.error) / light.mean, off = found.mean / light.mean - 1;
    const Estimate blocks = squared_bias(pictures, traced.batches, traced);
    MESSAGE(room.name << ": " << 100 * off << " % +- " << 100 * error << " % (light " << 100 * light.error / light.mean
                      << " %), squared bias of blocks " << blocks.mean << " +- " << blocks.error);
    CHECK(error < room.precision);
    CHECK(std::abs(off) < 4 * error);
    CHECK(std::abs(blocks.mean) < 4 * blocks.error);
    squares += off * off / (error * error), ++count;
  }
  const SquareBand band = mean_square_band(count);
  CHECK(squares / count > band.low);
  CHECK(squares / count < band.high);
}

}  // namespace tyndall::test::light_traced_slow_test
