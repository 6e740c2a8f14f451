#include "app/text/progress.h"

#include <doctest/doctest.h>

#include <limits>

namespace tyndall::test::progress_test {

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST_CASE("the part done is that of the limit which is nearest; samples that a continued film brings do not count") {
  const RenderProgress now{16, 5, 40, 0.1};
  CHECK(progress_fraction(now, {.spp = 64}) == 0.25);
  CHECK(progress_fraction(now, {.spp = 64, .time_limit = 10}) == 0.5);
  CHECK(progress_fraction(now, {.target_error = 0.05}) == doctest::Approx(0.25));  // a quarter of the samples
  CHECK(progress_fraction(now, {.target_error = 0.2}) == 1);
  CHECK(progress_fraction(now, {}) == 0);
  CHECK(progress_fraction({0, 0, 0, infinity}, {.spp = 64, .target_error = 0.1}) == 0);
  CHECK(progress_fraction({32, 1, 1, 1}, {.spp = 64}, 32) == 0);
  CHECK(progress_fraction({48, 1, 1, 1}, {.spp = 64}, 32) == 0.5);
}

TEST_CASE("durations are shown in seconds, minutes or hours") {
  for (const auto& [seconds, text] :
       {std::pair{0.0, "0.0 s"}, std::pair{12.34, "12.3 s"}, std::pair{59.94, "59.9 s"}, std::pair{59.96, "1:00"},
        std::pair{245.0, "4:05"}, std::pair{3599.6, "1:00:00"}, std::pair{3723.0, "1:02:03"}, std::pair{1e12, "years"}})
    CHECK(duration(seconds) == text);
}

TEST_CASE("the line says what is known and leaves out what is not") {
  CHECK(progress_text({16, 12.3, 45.25, 0.031}, {.spp = 64}) ==
        "16/64 spp, 45.2 Mrays/s, error 0.031, 12.3 s, 36.9 s left");
  CHECK(progress_text({0, 1, 0, infinity}, {.spp = 64}) == "0/64 spp, 1.0 s");
  CHECK(progress_text({7, 3, 2, infinity}, {}) == "7 spp, 2 Mrays/s, 3.0 s");
}

}  // namespace tyndall::test::progress_test
