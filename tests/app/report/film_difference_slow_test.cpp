#include "tests/support/sweep_films.h"

#include <doctest/doctest.h>

namespace tyndall::test::film_difference_slow_test {

TEST_CASE("sweep: with one seed differences are cleaner than with two, and their stated error is the true one") {
  for (const auto& [step, least_gain] :
       {std::pair{SweepStep{"showroom", "/materials/gold/fuzz", "0.18", "0.20", 96, 54}, 4.0},
        std::pair{SweepStep{"glass-spheres", "/materials/glass/refractive_index", "1.5", "1.55", 96, 54}, 3.0},
        std::pair{SweepStep{"cornell-smoke", "/objects/6/density", "0.01", "0.011", 96, 54}, 20.0},
        std::pair{SweepStep{"defocus", "/camera/focus_distance", "3.4", "3.6", 96, 54}, 2.0},
        std::pair{SweepStep{"showroom", "/camera/vfov", "34", "35", 96, 54}, 1.4}}) {
    const SweepErrors errors = errors_of(step, 20, 2048);
    MESSAGE(step.scene, " ", step.pointer, ": ", errors.gain, " times cleaner; stated over true ", errors.ratio);
    CHECK(errors.gain >= least_gain);
    CHECK(errors.ratio > 0.8);
    CHECK(errors.ratio < 1.25);
  }
}

}  // namespace tyndall::test::film_difference_slow_test
