#include "app/window/rendering/picture_view.h"

#include "tests/app/window/panels/null_imgui.h"

#include <doctest/doctest.h>

namespace tyndall::test::split_view_test {

TEST_CASE("the divider is taken near its line only, within the image") {
  const Rect image{100, 50, 500, 250};
  Divider divider;
  CHECK(divider.x(image) == 300);
  CHECK(divider.is_at(image, 305, 100, 6));
  CHECK_FALSE(divider.is_at(image, 307, 100, 6));
  CHECK_FALSE(divider.is_at(image, 300, 49, 6));
  CHECK_FALSE(divider.is_at(image, 300, 250, 6));
  CHECK_FALSE(divider.is_at({}, 0, 0, 6));
}

TEST_CASE("the divider follows the mouse, and leaves something of each half") {
  const Rect image{100, 50, 500, 250};
  Divider divider;
  divider.drag_to(image, 400);
  CHECK(divider.x(image) == doctest::Approx(400));
  divider.drag_to(image, 2000);
  CHECK(divider.x(image) < 500);
  CHECK(divider.x(image) > 480);
  divider.drag_to(image, -2000);
  CHECK(divider.x(image) > 100);
  CHECK(divider.x(image) < 120);
  divider.drag_to({}, 5);
  CHECK(divider.x(image) < 120);
}

TEST_CASE("a split view can be drawn at any size") {
  NullImGui imgui(64, 64);
  Ui ui;
  for (const Rect& rect : {Rect{0, 0, 20, 10}, Rect{0, 0, 1, 50}, Rect{0, 0, 0, 0}, Rect{0, 0, 372, 400}})
    imgui.frame([&] { draw_split(ui, rect, {}, "mis · sobol", "path"); });
}

TEST_CASE("the divider follows the mouse that took it, also where its press is seen late") {
  const Rect image{0, 0, 200, 100};
  Divider divider;
  Mouse mouse;
  mouse.x = 101, mouse.y = 50;
  CHECK_FALSE(divider.follow(mouse, image, true, 6));
  CHECK(divider.hovered);
  mouse.x = 150, mouse.clicked[0] = mouse.down[0] = true;  // pressed at 101, and gone when this is drawn
  CHECK(divider.follow(mouse, image, true, 6));
  CHECK(divider.x(image) == doctest::Approx(150));
  mouse.clicked[0] = mouse.down[0] = false;
  CHECK(divider.follow(mouse, image, true, 6));  // the release, too, belongs to the divider
  CHECK_FALSE(divider.follow(mouse, image, true, 6));
  mouse.clicked[0] = mouse.down[0] = true;
  CHECK_FALSE(divider.follow(mouse, image, false, 6));  // something else has the mouse
  CHECK(divider.x(image) == doctest::Approx(150));
}

}  // namespace tyndall::test::split_view_test
