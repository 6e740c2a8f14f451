#include "core/base/sampling.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>

namespace tyndall::test::reservoir_test {

TEST_CASE("reservoir: things are taken in proportion to their weights, by one random number") {
  constexpr std::array<float, 6> weights{0, 3, 0, 1, 4, 0};
  constexpr int draws = 80'000;
  std::array<int, 6> taken{};
  for (int i = 0; i < draws; ++i) {
    Reservoir<float> reservoir{(static_cast<float>(i) + 0.5f) / draws};
    std::size_t last = 0;
    for (std::size_t k = 0; k < weights.size(); ++k)
      if (reservoir.offer(weights[k])) last = k;
    CHECK(reservoir.weight == 8);
    ++taken[last];
  }
  for (std::size_t k = 0; k < weights.size(); ++k)
    CHECK(std::abs(static_cast<float>(taken[k]) - weights[k] / 8 * draws) <= 20);
}

TEST_CASE("reservoir: nothing is taken where all weights are 0") {
  Reservoir<float> reservoir{0.5f};
  CHECK(!reservoir.offer(0));
  CHECK(!reservoir.offer(0));
  CHECK(reservoir.weight == 0);
  CHECK(reservoir.pick == 0.5f);
}

}  // namespace tyndall::test::reservoir_test
