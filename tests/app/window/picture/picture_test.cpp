#include "app/window/picture/display.h"
#include "app/window/rendering/picture_view.h"
#include "tests/app/window/null_imgui.h"
#include "tests/app/window/scenes.h"

#include <cmath>
#include <limits>

namespace tyndall::test::picture_test {

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

const Rect area{0, 0, 900, 700}, fit{0, 68, 900, 631};  // a picture of 1600 x 1000

/// A picture that fits into that area, enlarged.
struct Zoomed {
  int width = 1600, height = 1000;
  float dots = 1;
  ImageZoom zoom{};

  Rect place() { return zoom.place(area, fit, width, height, dots); }
};

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

TEST_CASE("a look: luminance in stops from middle grey, counted with the exposure; black where there is none") {
  const Look stops{.stops = true};
  for (int stop = darkest_stop; stop <= brightest_stop; ++stop)
    for (const double off : {-0.49, 0.0, 0.49}) {
      const float grey = 0.18f * static_cast<float>(std::exp2(stop + off));
      CHECK(shown({grey, grey, grey, 1}, stops) == band(stop));
    }
  const float infinity = std::numeric_limits<float>::infinity();
  CHECK(shown({1e-20f, 1e-20f, 1e-20f, 1}, stops) == band(darkest_stop));
  CHECK(shown({1e30f, 0, 0, 1}, stops) == band(brightest_stop));
  CHECK(shown({0.18f, 0.18f, 0.18f, 1}, {.exposure = 3, .stops = true}) == band(3));
  CHECK(shown({0.18f / 0.7152f, 0, 0, 1}, stops) == band(-2));  // red light is darker than green of the same strength
  CHECK(shown({0, 0.18f / 0.7152f, 0, 1}, stops) == band(0));
  CHECK(shown({0, -1, std::nanf(""), 1}, stops) == Bytes{0, 0, 0, 255});
  CHECK(shown({infinity, infinity, infinity, 1}, {.exposure = 100, .stops = true}) == band(brightest_stop));
}

TEST_CASE("zoom: what is under the cursor stays there, down to where all is shown, or as small as the picture is") {
  Zoomed large;
  const auto pixel = [&] {
    const Rect image = large.place();
    return std::pair((300 - image.x0) / image.width() * 1600, (200 - image.y0) / image.height() * 1000);
  };
  CHECK(large.place() == fit);
  CHECK(large.zoom.fits());
  for (const float factor : {1.25f, 2.0f, 3.0f, 0.7f}) {
    const auto before = pixel();
    large.zoom.enlarge(factor, 300, 200);
    CHECK(pixel().first == about(before.first, 0.01));
    CHECK(pixel().second == about(before.second, 0.01));
    CHECK(large.place().width() / large.place().height() == doctest::Approx(1.6));
  }
  CHECK(large.zoom.dots_a_pixel() == doctest::Approx(0.5625 * 1.25 * 2 * 3 * 0.7));
  large.zoom.enlarge(0.01f, 300, 200);
  CHECK(large.zoom.fits());
  CHECK(large.place() == fit);
  Zoomed small{320, 200};
  small.place();
  small.zoom.toggle(5, 70);
  CHECK(small.place() == Rect{290, 250, 610, 450});  // in the middle, wherever the mouse was
  for (const auto& [factor, width] : {std::pair{1.25f, 400.0}, {0.1f, 320.0}}) {
    small.zoom.enlarge(factor, 450, 350);
    CHECK(small.place().width() == doctest::Approx(width));
  }
  CHECK_FALSE(small.zoom.fits());
}

TEST_CASE("zoom: actual size is one pixel for each of the screen's, on whole pixels, and again all of the picture") {
  for (const float dots : {1.0f, 2.0f}) {
    Zoomed picture{1600, 1000, dots};
    picture.place();
    picture.zoom.toggle(333, 222);
    const Rect image = picture.place();
    CHECK(image.width() * dots == doctest::Approx(1600));
    CHECK(image.x0 * dots == doctest::Approx(std::round(image.x0 * dots)));
    CHECK(picture.zoom.dots_a_pixel() == 1);
    picture.zoom.move(10, -20);
    CHECK(picture.place().x0 == about(image.x0 + 10, 0.001));
    CHECK(picture.place().y0 == about(image.y0 - 20, 0.001));
    picture.zoom.move(1e6f, 1e6f);  // it cannot be moved out of sight
    CHECK(overlap(picture.place(), area).width() > 100);
    picture.zoom.toggle(0, 0);
    CHECK(picture.zoom.fits());
  }
}

TEST_CASE("the divider is taken near its line only, follows the mouse, and leaves something of each half") {
  const Rect image{100, 50, 500, 250};
  Divider divider;
  Mouse mouse;
  const auto at = [&](float x, float y) {
    mouse.x = x, mouse.y = y;
    CHECK_FALSE(divider.follow(mouse, image, true, 6));
    return divider.hovered;
  };
  const auto hold = [&](bool down) { mouse.clicked[0] = mouse.down[0] = down; };
  CHECK(divider.x(image) == 300);
  CHECK_FALSE(at(307, 100));
  CHECK_FALSE(at(300, 49));
  CHECK_FALSE(at(300, 250));
  CHECK(at(305, 100));
  hold(true);  // pressed at 305, and gone when this is drawn
  for (const auto& [to, low, high] :
       {std::tuple{400.0f, 399.0f, 401.0f}, {2000.0f, 480.0f, 500.0f}, {-2000.0f, 100.0f, 120.0f}}) {
    mouse.x = to;
    CHECK(divider.follow(mouse, image, true, 6));
    CHECK(divider.x(image) > low);
    CHECK(divider.x(image) < high);
  }
  hold(false);
  CHECK(divider.follow(mouse, image, true, 6));  // the release, too, belongs to the divider
  CHECK_FALSE(divider.follow(mouse, image, true, 6));
  mouse.x = divider.x(image);
  hold(true);
  CHECK_FALSE(divider.follow(mouse, image, false, 6));  // something else has the mouse
  CHECK(divider.x(image) < 120);
  divider.drag_to({}, 5);
  CHECK_FALSE(divider.is_at({}, 0, 0, 6));
}

TEST_CASE("a split view can be drawn at any size") {
  NullImGui imgui(64, 64);
  Ui ui;
  for (const Rect& rect : {Rect{0, 0, 20, 10}, Rect{0, 0, 1, 50}, Rect{0, 0, 0, 0}, Rect{0, 0, 372, 400}})
    imgui.frame([&] { draw_split(ui, rect, {}, "mis · sobol", "path"); });
}

}  // namespace tyndall::test::picture_test
