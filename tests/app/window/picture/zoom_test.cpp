#include "app/window/picture/display.h"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>

namespace tyndall::test::zoom_test {

namespace {

const Rect area{0, 0, 900, 700}, fit{0, 68, 900, 631};  // a picture of 1600 x 1000

/// The point of the picture that is at a place of the window, in pixels.
struct Point {
  float x, y;
};
Point pixel_at(const Rect& image, float x, float y) {
  return {(x - image.x0) / image.width() * 1600, (y - image.y0) / image.height() * 1000};
}

}  // namespace

TEST_CASE("zoom: what is under the cursor stays there, down to where all is shown") {
  ImageZoom zoom;
  CHECK(zoom.place(area, fit, 1600, 1000, 1) == fit);
  CHECK(zoom.fits());
  Rect image = fit;
  for (const float factor : {1.25f, 2.0f, 3.0f, 0.7f}) {
    const Point before = pixel_at(image, 300, 200);
    zoom.enlarge(factor, 300, 200);
    image = zoom.place(area, fit, 1600, 1000, 1);
    const Point after = pixel_at(image, 300, 200);
    CHECK(after.x == doctest::Approx(before.x).epsilon(0.01).scale(0));
    CHECK(after.y == doctest::Approx(before.y).epsilon(0.01).scale(0));
    CHECK(image.width() / image.height() == doctest::Approx(1.6));
  }
  CHECK(zoom.dots_a_pixel() == doctest::Approx(0.5625 * 1.25 * 2 * 3 * 0.7));
  zoom.enlarge(0.01f, 300, 200);
  CHECK(zoom.fits());
  CHECK(zoom.place(area, fit, 1600, 1000, 1) == fit);
}

TEST_CASE("zoom: a small picture can be made as small as it is") {
  const Rect small_fit{0, 68, 900, 631};
  ImageZoom zoom;
  zoom.place(area, small_fit, 320, 200, 1);
  zoom.toggle(5, 70);
  CHECK(zoom.place(area, small_fit, 320, 200, 1) == Rect{290, 250, 610, 450});  // in the middle, wherever the mouse was
  zoom.enlarge(1.25f, 450, 350);
  CHECK(zoom.place(area, small_fit, 320, 200, 1).width() == doctest::Approx(400));
  zoom.enlarge(0.1f, 450, 350);
  CHECK(zoom.place(area, small_fit, 320, 200, 1).width() == doctest::Approx(320));
  CHECK_FALSE(zoom.fits());
}

TEST_CASE("zoom: actual size is one pixel for each of the screen's, on whole pixels, and again all of the picture") {
  for (const float dots : {1.0f, 2.0f}) {
    ImageZoom zoom;
    zoom.place(area, fit, 1600, 1000, dots);
    zoom.toggle(333, 222);
    const Rect image = zoom.place(area, fit, 1600, 1000, dots);
    CHECK(image.width() * dots == doctest::Approx(1600));
    CHECK(image.x0 * dots == doctest::Approx(std::round(image.x0 * dots)));
    CHECK(zoom.dots_a_pixel() == 1);
    zoom.move(10, -20);
    const Rect moved = zoom.place(area, fit, 1600, 1000, dots);
    CHECK(moved.x0 == doctest::Approx(image.x0 + 10).epsilon(0.001).scale(0));
    CHECK(moved.y0 == doctest::Approx(image.y0 - 20).epsilon(0.001).scale(0));
    zoom.move(1e6f, 1e6f);  // it cannot be moved out of sight
    CHECK(overlap(zoom.place(area, fit, 1600, 1000, dots), area).width() > 100);
    zoom.toggle(0, 0);
    CHECK(zoom.fits());
  }
}

}  // namespace tyndall::test::zoom_test
