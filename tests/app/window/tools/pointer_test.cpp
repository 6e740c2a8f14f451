#include "app/window/tools/pointer.h"
#include "app/window/tools/camera_control.h"
#include "tests/app/window/scenes.h"

namespace tyndall::test::pointer_test {

namespace {

/// A picture of 400 x 300 units in a window, a camera, and a mouse to press and move.
struct Hand {
  PointerTool tool;
  PressedButton clicked = PressedButton::none;
  Mouse mouse;
  Camera camera;
  Layout layout = make_layout(400, 330, 400, 300, 1, 0);

  /// Whether the left button was clicked.
  bool update(bool free = true) {
    clicked = tool.update(mouse, layout, 1, free, 10, camera);
    mouse.dx = mouse.dy = mouse.wheel = 0;
    for (bool& button : mouse.clicked) button = false;
    return clicked == PressedButton::left;
  }
  /// Presses a button; whether the tool has it then.
  bool press(int button, float x, float y, bool free = true) {
    mouse.x = mouse.pressed_x[button] = x, mouse.y = mouse.pressed_y[button] = y;
    mouse.clicked[button] = mouse.down[button] = true;
    CHECK_FALSE(update(free));
    return tool.is_pressed();
  }
  bool move(float dx, float dy) {
    mouse.x += dx, mouse.y += dy, mouse.dx = dx, mouse.dy = dy;
    return update();
  }
  bool release(int button = 0) {
    mouse.down[button] = false;
    return update();
  }
};

}  // namespace

TEST_CASE("a press without movement is a click, also if the hand trembles a little, or no drawing was between them") {
  Hand hand;
  CHECK(hand.press(0, 100, 100));
  CHECK_FALSE(hand.move(2, 2));
  CHECK(hand.release());
  CHECK_FALSE(hand.tool.is_pressed());
  CHECK(hand.camera == Camera());
  hand.press(1, 100, 100);
  CHECK_FALSE(hand.release(1));
  CHECK(hand.clicked == PressedButton::right);
  Hand quick;
  quick.mouse.x = quick.mouse.y = quick.mouse.pressed_x[0] = quick.mouse.pressed_y[0] = 100;
  quick.mouse.clicked[0] = true;
  CHECK(quick.update());
}

TEST_CASE("a drag goes on outside the picture, but does not begin there or while a dialog asks") {
  Hand hand;
  CHECK_FALSE(hand.press(0, 100, 100, false));
  CHECK_FALSE(hand.press(0, 100, 320));  // on the status line, below the picture
  hand.mouse.taken = true;
  CHECK_FALSE(hand.press(0, 100, 100));
  hand.mouse.taken = false;
  CHECK(hand.camera == Camera());
  CHECK(hand.press(0, 100, 100));
  hand.move(-500, 0);
  CHECK_FALSE(hand.camera == Camera());
}

TEST_CASE("a click knows its pixel, also at the edges; clicks are at one place if mouse and camera stay") {
  const Rect image{100, 50, 300, 150};
  const auto pixel = [&](float x, float y) {
    const PictureClick click = click_at(image, x, y, 20, 10);
    return std::pair(click.x, click.y);
  };
  CHECK(pixel(100, 50) == std::pair(0, 0));
  CHECK(pixel(299.99f, 149.99f) == std::pair(19, 9));
  CHECK(pixel(200, 100).second == 5);
  CHECK(click_at(image, 200, 100, 20, 10).at.x == doctest::Approx(0.5));
  ClickPlace place;
  Camera camera;
  CHECK_FALSE(place.again(10, 10, 1, camera));
  CHECK(place.again(13, 10, 1, camera));
  CHECK_FALSE(place.again(30, 10, 1, camera));
  camera.vfov = 50;
  CHECK_FALSE(place.again(30, 10, 1, camera));
}

TEST_CASE("fog is selected where nothing else is, or by a second click") {
  const Scene scene = seen_scene(100, 100, {0, 0, 0}, 90, {ball("", {0, 0, -5}), fog(Sphere<>{{0, 0, -2}, 0.5, {}})});
  const Renderer::Pick on_sphere{{0}, 4, {0, 0, -4}}, nothing{};
  const auto clicked = [&](const Renderer::Pick& pick, double x, const ObjectPath& selected, bool again) {
    return clicked_object(scene, pick, {x, 0.5}, selected, again);
  };
  CHECK(clicked(on_sphere, 0.5, {}, false) == ObjectPath{0});
  CHECK(clicked(on_sphere, 0.5, {0}, true) == ObjectPath{1});
  CHECK(clicked(on_sphere, 0.5, {1}, true) == ObjectPath{0});
  CHECK(clicked(on_sphere, 0.5, {0}, false) == ObjectPath{0});
  CHECK(clicked(nothing, 0.5, {}, false) == ObjectPath{1});
  CHECK(clicked(nothing, 0.99, {}, false).empty());
}

TEST_CASE("clicks at one place go on to what lies behind, and from the last object to the first again") {
  const Scene scene = seen_scene(
      100, 100, {0, 0, 0}, 90,
      {ball("", {0, 0, -9}), ball("", {0, 0, -4}, 2), ball("", {0, 0, -4}, -1.5), fog(Sphere<>{{0, 0, -20}, 3, {}})});
  const Renderer::Pick front{{1}, 2, {0, 0, -2}};
  ObjectPath now = clicked_object(scene, front, {0.5, 0.5}, {}, false);
  std::vector<ObjectPath> seen{now};
  for (int k = 0; k < 4; ++k) seen.push_back(now = clicked_object(scene, front, {0.5, 0.5}, now, true));
  CHECK(seen == std::vector<ObjectPath>{{1}, {3}, {2}, {0}, {1}});
}

}  // namespace tyndall::test::pointer_test
