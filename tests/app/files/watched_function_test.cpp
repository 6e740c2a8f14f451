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

}  // namespace

TEST_CASE("watched function: values go through, and nothing is told") {
  const WatchedFunction watched([](void*, double x, double y, std::uint64_t sample,
                                   double rgb[3]) { rgb[0] = x, rgb[1] = y, rgb[2] = static_cast<double>(sample); },
                                nullptr);
  CHECK(answer(watched) == Vec3f{3.2f, 4.9f, 5});
  CHECK(watched.problems() == 0);
  CHECK(watched.first_problem().empty());
}

TEST_CASE("watched function: what has no value is rejected by films, and the first is told") {
  int news = 0;
  WatchedFunction watched(
      [](void*, double, double, std::uint64_t sample, double rgb[3]) {
        if (sample == 0) return;
        if (sample == 1) throw std::runtime_error("one\nline");
        if (sample == 2) throw 2;
        rgb[0] = rgb[1] = 1, rgb[2] = sample == 3 ? 1e20 : 1e12;
        if (sample == 4) CHECK(WatchedFunction::fail("a reason"));
        if (sample == 5) CHECK(WatchedFunction::fail(nullptr));
      },
      nullptr);
  watched.set_on_news([&] { ++news; });
  for (const std::uint64_t sample : {1u, 0u, 2u, 3u, 4u, 5u}) CHECK(std::isnan(answer(watched, sample).x));
  CHECK(answer(watched, 6).z == 1e12f);
  CHECK(watched.problems() == 6);
  CHECK(news == 1);
  CHECK(watched.first_problem() == "pixel (3, 4), sample 1: one\\nline");
}

TEST_CASE("watched function: each reason") {
  const auto reason = [](WatchedFunction::Function function) {
    const WatchedFunction watched(function, nullptr);
    answer(watched);
    return watched.first_problem().substr(std::string("pixel (3, 4), sample 5: ").size());
  };
  CHECK(reason([](void*, double, double, std::uint64_t, double*) {
        }).starts_with("found (nan, nan, nan), expected finite"));
  CHECK(reason([](void*, double, double, std::uint64_t, double rgb[3]) {
          rgb[0] = 1, rgb[1] = 0.25, rgb[2] = -std::numeric_limits<double>::infinity();
        }).starts_with("found (1, 0.25, -inf)"));
  CHECK(reason([](void*, double, double, std::uint64_t, double*) { throw 1; }) ==
        "an exception that is no std::exception");
  CHECK(reason([](void*, double, double, std::uint64_t, double*) { WatchedFunction::fail("no mesh"); }) == "no mesh");
  CHECK(reason([](void*, double, double, std::uint64_t, double*) { WatchedFunction::fail(nullptr); }) ==
        "no reason was given");
  std::thread([] { CHECK_FALSE(WatchedFunction::fail("no sample of a picture")); }).join();
}

}  // namespace tyndall::test::watched_function_test
