#include "tests/support/pictures.h"

#include <doctest/doctest.h>

#include <atomic>

namespace tyndall::test::first_seen_test {

namespace {

struct Seen {
  CleanInput input;
  FirstSeenParts made;

  float at(int plane, int x, int y) const { return input.seen.plane(plane)[y * input.seen.stride() + x]; }
};

Seen seen_in(const char* name, double spp, const Region& region, int threads = 2, const char* isa = "") {
  const RenderScene compiled = compile(small_scene(name, 96, 54, 1));
  const SceneViewOf view(compiled);
  const auto kernels = choose_kernels(isa);
  ThreadPool thread_pool(threads);
  Seen seen;
  seen.input.spp = spp;
  REQUIRE(find_first_seen(region, {thread_pool, *kernels, view.view()}, false, seen.input, seen.made));
  return seen;
}

constexpr Region whole{0, 0, 96, 54};
constexpr int nearness = 6;

/// How much of a pixel is covered by what is seen there, where all that is seen is far from the camera alike.
int partly_covered(const Seen& seen) {
  float maximum = 0;
  for (int y = 0; y < 54; ++y)
    for (int x = 0; x < 96; ++x) maximum = std::max(maximum, seen.at(nearness, x, y));
  int pixels = 0;
  for (int y = 0; y < 54; ++y)
    for (int x = 0; x < 96; ++x) {
      const float covered = seen.at(nearness, x, y) / maximum;
      pixels += covered > 0.02f && covered < 0.4f ? 1 : 0;
    }
  return pixels;
}

}  // namespace

TEST_CASE("first seen: pixels at edges show the mean of what their parts see, with as many rays as the samples allow") {
  const Seen once = seen_in("earth", 0.01, whole), often = seen_in("earth", 64, whole);
  CHECK(once.made.parts == 1);
  CHECK(often.made.parts == 8);
  CHECK(partly_covered(once) == 0);
  CHECK(partly_covered(often) > 20);
  CHECK(often.made.unlike > 200);
  CHECK(often.made.unlike < 96 * 54 / 2);
  for (int plane = 0; plane < 8; ++plane) CHECK(once.at(plane, 1, 1) == often.at(plane, 1, 1));  // nothing but sky
  for (const double spp : {1.0, 4.0, 16.0, 100.0}) {
    const FirstSeenParts made = seen_in("perlin-spheres", spp, whole).made;
    CAPTURE(spp);
    CHECK(made.parts == parts_of_pixels(made, spp));
    CHECK(static_cast<double>(made.unlike * made.parts * made.parts) <= spp * 96 * 54);
  }
}

TEST_CASE("first seen: the same for any number of threads and, but for rounding, for any instruction set") {
  const Seen one = seen_in("showroom", 16, whole, 1), three = seen_in("showroom", 16, whole, 3),
             scalar = seen_in("showroom", 16, whole, 2, "scalar");
  int differ = 0;
  for (int plane = 0; plane < 8; ++plane)
    for (int y = 0; y < 54; ++y)
      for (int x = 0; x < 96; ++x) {
        REQUIRE(one.at(plane, x, y) == three.at(plane, x, y));
        differ += std::abs(one.at(plane, x, y) - scalar.at(plane, x, y)) > 0.02f ? 1 : 0;
      }
  CHECK(differ < 96 * 54 * 8 / 500);
}

TEST_CASE("first seen: regions see what the whole picture sees there") {
  const Seen all = seen_in("quads", 64, whole), part = seen_in("quads", 64, {40, 8, 77, 41});
  for (int plane = 0; plane < 6; ++plane)  // all but the nearness, whose unit is the picture's mean depth
    for (int y = 1; y < 32; ++y)
      for (int x = 1; x < 36; ++x)
        REQUIRE(part.at(plane, x, y) == doctest::Approx(all.at(plane, x + 40, y + 8)).epsilon(0.05));
}

TEST_CASE("first seen: gives up") {
  const Ready ready(compile(small_scene("quads", 16, 9, 1)));
  CleanInput input;
  FirstSeenParts made;
  CHECK_FALSE(find_first_seen({0, 0, 16, 9}, ready.engine, true, input, made));
}

}  // namespace tyndall::test::first_seen_test
