#include "app/window/picture/display.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

namespace tyndall::test::look_test {

namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes shown(const std::vector<float>& rgba, const Look& look, int width = 1) {
  Bytes bytes;
  screen_bytes(rgba, width, look, bytes);
  return bytes;
}

Bytes band(int stop) {
  const ScreenColour& c = stop_colours[static_cast<std::size_t>(stop - darkest_stop)];
  const auto byte = [](float v) { return static_cast<std::uint8_t>(std::lround(255 * v)); };
  return {byte(c[0]), byte(c[1]), byte(c[2]), 255};
}

}  // namespace

TEST_CASE("a look: what the screen shows is what a PNG would hold") {
  std::vector<float> rgba, rgb;
  for (int i = 0; i < 64; ++i) {
    const float light = 0.02f * static_cast<float>(i);
    rgba.insert(rgba.end(), {light, 0.5f * light, 0.3f, 1});
    rgb.insert(rgb.end(), {light, 0.5f * light, 0.3f});
  }
  const Look look{.exposure = 0.7, .tone_map = ToneMap::aces, .dither = true};
  const Bytes screen = shown(rgba, look, 16), png = tone_map(rgb, 0.7, ToneMap::aces, 16, DitherOrigin{});
  for (std::size_t i = 0; i < 64; ++i)
    for (std::size_t c = 0; c < 3; ++c) REQUIRE(screen[4 * i + c] == png[3 * i + c]);
}

TEST_CASE("a look: luminance in stops from middle grey, counted with the exposure") {
  const Look stops{.stops = true};
  for (int stop = darkest_stop; stop <= brightest_stop; ++stop)
    for (const double off : {-0.49, 0.0, 0.49}) {
      const float grey = 0.18f * static_cast<float>(std::exp2(stop + off));
      CHECK(shown({grey, grey, grey, 1}, stops) == band(stop));
    }
  CHECK(shown({1e-20f, 1e-20f, 1e-20f, 1}, stops) == band(darkest_stop));
  CHECK(shown({1e30f, 0, 0, 1}, stops) == band(brightest_stop));
  CHECK(shown({0.18f, 0.18f, 0.18f, 1}, {.exposure = 3, .stops = true}) == band(3));
  CHECK(shown({0.18f / 0.7152f, 0, 0, 1}, stops) == band(-2));  // red light is darker than green of the same strength
  CHECK(shown({0, 0.18f / 0.7152f, 0, 1}, stops) == band(0));
}

TEST_CASE("a look: where there is no light, and where it is not a number, stops are black") {
  const float infinity = std::numeric_limits<float>::infinity();
  CHECK(shown({0, -1, std::nanf(""), 1}, {.stops = true}) == Bytes{0, 0, 0, 255});
  CHECK(shown({infinity, infinity, infinity, 1}, {.exposure = 100, .stops = true}) == band(brightest_stop));
}

}  // namespace tyndall::test::look_test
