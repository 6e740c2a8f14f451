#include "app/window/tools/pointer.h"

#include "app/window/tools/camera_control.h"
#include "core/scene/load.h"

#include <doctest/doctest.h>

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
  bool update(bool free = true, double now = 10) {
    clicked = tool.update(mouse, layout, 1, free, now, camera);
    mouse.dx = mouse.dy = mouse.wheel = 0;
    for (bool& button : mouse.clicked) button = false;
    return clicked == PressedButton::left;
  }
  void press(int button, float x, float y) {
    mouse.x = mouse.pressed_x[button] = x, mouse.y = mouse.pressed_y[button] = y;
    mouse.clicked[button] = mouse.down[button] = true;
  }
  void move(float dx, float dy) { mouse.x += dx, mouse.y += dy, mouse.dx = dx, mouse.dy = dy; }
};

}  // namespace

TEST_CASE("a press without movement is a click, also if the hand trembles a little") {
  Hand hand;
  const Camera before = hand.camera;
  hand.press(0, 100, 100);
  CHECK_FALSE(hand.update());
  CHECK(hand.tool.is_pressed());
  hand.move(2, 2);
  CHECK_FALSE(hand.update());
  hand.mouse.down[0] = false;
  CHECK(hand.update());
  CHECK_FALSE(hand.tool.is_pressed());
  CHECK(hand.camera == before);
}

TEST_CASE("a press and a release between two drawings are a click") {
  Hand hand;
  hand.press(0, 100, 100);
  hand.mouse.down[0] = false;
  CHECK(hand.update());
}

TEST_CASE("a right press without movement is a click of its own") {
  Hand hand;
  hand.press(1, 100, 100);
  hand.update();
  hand.mouse.down[1] = false;
  CHECK_FALSE(hand.update());
  CHECK(hand.clicked == PressedButton::right);
}

TEST_CASE("drags: left orbits, middle pans, right dollies, none is a click") {
  for (const int button : {0, 1, 2}) {
    Hand hand;
    const double distance = target_distance(hand.camera);
    hand.press(button, 100, 100);
    hand.update();
    hand.move(0, 60);
    CHECK_FALSE(hand.update());
    const bool nearer = target_distance(hand.camera) == doctest::Approx(distance);
    CHECK(nearer == (button != 1));
    CHECK((hand.camera.look_at == Camera().look_at) == (button != 2));
    CHECK_FALSE(hand.camera.look_from == Camera().look_from);
    hand.mouse.down[button] = false;
    CHECK_FALSE(hand.update());
  }
}

TEST_CASE("a drag goes on outside the picture, but does not begin there or while a dialog asks") {
  Hand hand;
  const Camera before = hand.camera;
  hand.press(0, 100, 100);
  hand.update(false);
  CHECK_FALSE(hand.tool.is_pressed());
  hand.press(0, 100, 320);  // on the status line, below the picture
  hand.update();
  CHECK_FALSE(hand.tool.is_pressed());
  hand.mouse.taken = true;
  hand.press(0, 100, 100);
  hand.update();
  CHECK_FALSE(hand.tool.is_pressed());
  hand.mouse.taken = false;
  hand.press(0, 100, 100);
  hand.update();
  hand.move(-500, 0);
  hand.update();
  CHECK_FALSE(hand.camera == before);
}

TEST_CASE("the wheel dollies, with Ctrl it changes the field of view; quick steps are undone as one") {
  Hand hand;
  hand.mouse.x = hand.mouse.y = 100;
  const double distance = target_distance(hand.camera);
  CHECK_FALSE(hand.tool.is_turning(hand.mouse, hand.layout, 9));
  hand.mouse.wheel = 1;
  CHECK(hand.tool.is_turning(hand.mouse, hand.layout, 10));
  hand.update(true, 10);
  CHECK(target_distance(hand.camera) == doctest::Approx(0.9 * distance));
  CHECK(hand.tool.is_turning(hand.mouse, hand.layout, 10.4));
  CHECK_FALSE(hand.tool.is_turning(hand.mouse, hand.layout, 10.6));
  const double vfov = hand.camera.vfov;
  hand.mouse.wheel = 1;
  hand.mouse.control = true;
  hand.update();
  CHECK(hand.camera.vfov < vfov);
  CHECK(target_distance(hand.camera) == doctest::Approx(0.9 * distance));
}

TEST_CASE("a click knows its pixel, also at the edges of the picture") {
  const Rect image{100, 50, 300, 150};
  const PictureClick first = click_at(image, 100, 50, 20, 10), last = click_at(image, 299.99f, 149.99f, 20, 10);
  CHECK(first.x == 0);
  CHECK(first.y == 0);
  CHECK(last.x == 19);
  CHECK(last.y == 9);
  CHECK(click_at(image, 200, 100, 20, 10).at.x == doctest::Approx(0.5));
  CHECK(click_at(image, 200, 100, 20, 10).y == 5);
}

TEST_CASE("fog is selected where nothing else is, or by a second click") {
  Scene scene;
  scene.width = scene.height = 100;
  scene.camera.vfov = 90;
  Object ball, fog;
  ball.kind = Solid3d{Sphere<>{{0, 0, -5}, 1, {}}, 0};
  Volume volume;
  volume.boundary = Sphere<>{{0, 0, -2}, 0.5, {}};
  fog.kind = volume;
  scene.objects = {ball, fog};
  const ImagePoint middle{0.5, 0.5};
  const Renderer::Pick on_sphere{{0}, 4, {0, 0, -4}}, nothing{};
  CHECK(clicked_object(scene, on_sphere, middle, {}, false) == ObjectPath{0});
  CHECK(clicked_object(scene, on_sphere, middle, {0}, true) == ObjectPath{1});
  CHECK(clicked_object(scene, on_sphere, middle, {1}, true) == ObjectPath{0});
  CHECK(clicked_object(scene, on_sphere, middle, {0}, false) == ObjectPath{0});
  CHECK(clicked_object(scene, nothing, middle, {}, false) == ObjectPath{1});
  CHECK(clicked_object(scene, nothing, {0.99, 0.5}, {}, false).empty());
}

TEST_CASE("clicks at one place go on to what lies behind, and from the last object to the first again") {
  Scene scene;
  scene.width = scene.height = 100;
  scene.camera.vfov = 90;
  const auto ball = [](double z, double radius) { return Object{"", Solid3d{Sphere<>{{0, 0, z}, radius, {}}, 0}, {}}; };
  Object fog{"", Volume{Sphere<>{{0, 0, -20}, 3, {}}, {}, {}, {}}, {}};
  scene.objects = {ball(-9, 1), ball(-4, 2), ball(-4, -1.5), fog};
  const Renderer::Pick front{{1}, 2, {0, 0, -2}};
  ObjectPath now = clicked_object(scene, front, {0.5, 0.5}, {}, false);
  std::vector<ObjectPath> seen{now};
  for (int k = 0; k < 4; ++k) seen.push_back(now = clicked_object(scene, front, {0.5, 0.5}, now, true));
  CHECK(seen == std::vector<ObjectPath>{{1}, {3}, {2}, {0}, {1}});
}

TEST_CASE("clicks are at one place if the mouse and the camera have stayed") {
  ClickPlace place;
  Camera camera;
  CHECK_FALSE(place.again(10, 10, 1, camera));
  CHECK(place.again(13, 10, 1, camera));
  CHECK_FALSE(place.again(30, 10, 1, camera));
  camera.vfov = 50;
  CHECK_FALSE(place.again(30, 10, 1, camera));
}

}  // namespace tyndall::test::pointer_test
