#include "app/files/watched_function.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>

/// A caller's function: what it computes, and what is told where it cannot.
namespace tyndall::test::watched_function_test {

namespace {

/// What the function answers for a sample of pixel (3, 4).
Vec3f answer(const WatchedFunction& watched, std::uint64_t sample = 5) {
  return watched.source()->sample(3.2, 4.9, sample);
}

/// Sample 6 alone has a value.
void compute(double x, double y, std::uint64_t sample, double rgb[3]) {
  if (sample == 0) return;
  if (sample == 1) throw std::runtime_error("one\nline");
  if (sample == 2) throw 2;
  rgb[0] = x, rgb[1] = y, rgb[2] = sample == 3 ? -std::numeric_limits<double>::infinity() : 1e12;
  if (sample == 4) CHECK(WatchedFunction::fail("no mesh"));
  if (sample == 5) CHECK(WatchedFunction::fail(nullptr));
  if (sample == 7) rgb[2] = 1e20;
}

}  // namespace

TEST_CASE("watched function: values go through, and nothing is told") {
  const WatchedFunction watched(compute);
  CHECK(answer(watched, 6) == Vec3f{3.2f, 4.9f, 1e12f});
  CHECK(watched.problems() == 0);
  CHECK(watched.first_problem().empty());
}

TEST_CASE("watched function: what has no value is rejected by films, and the first is told") {
  int news = 0;
  WatchedFunction watched(compute);
  watched.set_on_news([&] { ++news; });
  for (const std::uint64_t sample : {1u, 0u, 2u, 3u, 4u, 5u, 7u}) CHECK(std::isnan(answer(watched, sample).x));
  CHECK(answer(watched, 6).z == 1e12f);
  CHECK(watched.problems() == 7);
  CHECK(news == 1);
  CHECK(watched.first_problem() == "pixel (3, 4), sample 1: one\\nline");
}

TEST_CASE("watched function: each reason") {
  for (const auto& [sample, reason] : {std::pair{0u, "found (nan, nan, nan), expected finite numbers, at most 7e13"},
                                       std::pair{2u, "an exception that is no std::exception"},
                                       std::pair{3u, "found (3.2, 4.9, -inf), expected finite numbers, at most 7e13"},
                                       std::pair{4u, "no mesh"}, std::pair{5u, "no reason was given"}}) {
    const WatchedFunction watched(compute);
    answer(watched, sample);
    CHECK(watched.first_problem() == "pixel (3, 4), sample " + std::to_string(sample) + ": " + reason);
  }
  CHECK_FALSE(WatchedFunction::fail("no sample of a picture"));
}

}  // namespace tyndall::test::watched_function_test
