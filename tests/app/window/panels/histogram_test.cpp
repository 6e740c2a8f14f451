#include "app/window/panels/panels.h"

#include <doctest/doctest.h>

#include <numeric>

namespace tyndall::test::histogram_test {

namespace {

std::vector<float> picture_of(const std::vector<float>& greys) {
  std::vector<float> rgba;
  for (const float grey : greys) rgba.insert(rgba.end(), {grey, grey, grey, 1});
  return rgba;
}

}  // namespace

TEST_CASE("histogram: counts what the screen shows, with exposure and curve, and tells what is clipped") {
  std::vector<float> greys(1000, 0.5f);
  std::fill(greys.begin(), greys.begin() + 100, 2.0f);
  std::fill(greys.begin() + 100, greys.begin() + 150, 0.0f);
  Display display;
  Histogram histogram = histogram_of(picture_of(greys), display);
  CHECK(histogram.pixels == 1000);
  CHECK(histogram.white == doctest::Approx(0.1));
  CHECK(histogram.black == doctest::Approx(0.05));
  CHECK(histogram.counts[1][188 * 64 / 256] == 850);  // 0.5 is 188 on the screen
  CHECK(histogram.counts[2][63] == 100);
  CHECK(histogram_of({0, 1, 0, 1}, display).white == 1);  // one channel is enough
  display.exposure = 2;
  CHECK(histogram_of(picture_of(greys), display).white == doctest::Approx(0.95));
  display.exposure = 0, display.tone_map = ToneMap::aces;
  CHECK(histogram_of(picture_of(greys), display).white == 0);
}

TEST_CASE("histogram: of a large picture a part of the pixels is counted, from all of it") {
  std::vector<float> greys(640 * 480, 0.2f);
  for (std::size_t i = 0; i < greys.size() / 4; ++i) greys[i] = 3;
  const Histogram histogram = histogram_of(picture_of(greys), {});
  CHECK(histogram.pixels > 10000);
  CHECK(histogram.pixels < 20000);
  CHECK(histogram.white == doctest::Approx(0.25).epsilon(0.02).scale(0));
}

}  // namespace tyndall::test::histogram_test
