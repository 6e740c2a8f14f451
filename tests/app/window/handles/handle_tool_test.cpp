#include "app/window/handles/handles.h"

#include <doctest/doctest.h>

namespace tyndall::test::handle_tool_test {

namespace {

constexpr int key_enter = 257;

/// A sphere in the middle of a picture of 400 x 300, selected, and a mouse.
struct Hand {
  HandleTool tool;
  Mouse mouse;
  Scene scene;
  Layout layout = make_layout(400, 330, 400, 300, 1, 0);
  ObjectPaths selected{{0}};

  Hand() {
    scene.width = 400, scene.height = 300;
    scene.camera.look_from = {0, 0, 10};
    scene.camera.look_at = {0, 0, 0};
    scene.camera.vfov = 60;
    scene.materials = {{"grey", Vec3d{0.5, 0.5, 0.5}, Lambertian<>{}}};
    scene.objects = {{"ball", Solid3d{Sphere<>{{0, 0, 0}, 1, {}}, 0}, {}}};
    mouse.x = 200, mouse.y = 150;
  }
  bool update(bool free = true) {
    EditedScene edited(std::make_shared<const Scene>(scene));
    const bool taken = tool.update(mouse, layout, 1, free, selected, edited);
    if (auto changed = edited.take()) scene = std::move(*changed);
    mouse.dx = mouse.dy = 0;
    for (bool& button : mouse.clicked) button = false;
    return taken;
  }
  void press(int button = 0) {
    mouse.pressed_x[button] = mouse.x, mouse.pressed_y[button] = mouse.y;
    mouse.clicked[button] = mouse.down[button] = true;
  }
  void move(float dx, float dy) { mouse.x += dx, mouse.y += dy, mouse.dx = dx, mouse.dy = dy; }
  bool drag(float dx, float dy) {
    press();
    const bool taken = update();
    move(dx, dy);
    update();
    mouse.down[0] = false;
    update();
    return taken;
  }
  Vec3d center() const { return std::get<Sphere<>>(std::get<Solid3d>(scene.objects[0].kind).shape).center; }
};

}  // namespace

TEST_CASE("a drag on a handle moves, a drag beside it is left to others") {
  Hand hand;
  CHECK(hand.drag(50, 0));
  CHECK(hand.center().x == doctest::Approx(50 * 11.547 / 300).epsilon(0.01).scale(0));
  CHECK_FALSE(hand.tool.active());
  const Scene before = hand.scene;
  hand.mouse.x = 20, hand.mouse.y = 280;
  CHECK_FALSE(hand.drag(50, 0));
  CHECK(hand.scene == before);
}

TEST_CASE("handles are left alone while something else has the mouse, or nothing is selected") {
  Hand hand;
  hand.press();
  CHECK_FALSE(hand.update(false));
  hand.selected.clear();
  hand.press();
  CHECK_FALSE(hand.update());
}

TEST_CASE("a press on a handle that does not move is a click on what lies behind") {
  Hand hand;
  const Scene before = hand.scene;
  hand.press();
  hand.update();
  hand.move(2, 1);
  hand.update();
  hand.mouse.down[0] = false;
  CHECK(hand.update());
  CHECK(hand.tool.clicked_through());
  CHECK(hand.scene == before);
  CHECK_FALSE(hand.update());
  CHECK_FALSE(hand.tool.clicked_through());
}

TEST_CASE("with Shift the mouse moves a tenth") {
  Hand coarse, fine;
  coarse.drag(100, 0);
  fine.mouse.shift = true;
  fine.drag(100, 0);
  CHECK(fine.center().x == doctest::Approx(coarse.center().x / 10).epsilon(0.02).scale(0));
}

TEST_CASE("G moves without a button until a click, whose release is not for others") {
  Hand hand;
  hand.tool.grab(hand.mouse, hand.selected, hand.scene);
  CHECK(hand.tool.active());
  hand.move(30, 0);
  CHECK(hand.update());
  hand.press();
  CHECK(hand.update());
  CHECK_FALSE(hand.tool.active());
  CHECK(hand.center().x > 1);
  CHECK(hand.update());  // the button is still down
  hand.mouse.down[0] = false;
  CHECK_FALSE(hand.update());
}

TEST_CASE("G, then an axis, then a number and Enter: exactly that far; the same axis again frees it") {
  Hand hand;
  hand.tool.grab(hand.mouse, hand.selected, hand.scene);
  CHECK_FALSE(hand.tool.take_character('1'));  // along no axis
  for (const int key : {'Z', 'Z', 'X'}) CHECK(hand.tool.take_key(key));
  CHECK_FALSE(hand.tool.take_character('p'));  // no number begins with it
  for (const char character : {'-', '1', '.', '5', '7'}) CHECK(hand.tool.take_character(character));
  CHECK(hand.tool.take_key(259));  // Backspace
  hand.move(30, 10);
  hand.update();
  CHECK(hand.tool.said().substr(0, 6) == "x -1.5");
  CHECK_FALSE(hand.tool.take_key(256));  // Esc is for the window, which asks to cancel
  CHECK(hand.tool.take_key(key_enter));
  hand.update();
  CHECK(hand.center() == Vec3d{-1.5, 0, 0});
  CHECK_FALSE(hand.tool.take_key('X'));
}

TEST_CASE("what is typed for an axis may be a sum; until it is one the mouse decides") {
  Hand hand;
  hand.tool.grab(hand.mouse, hand.selected, hand.scene);
  CHECK(hand.tool.take_key('Y'));
  for (const char character : std::string("1/")) CHECK(hand.tool.take_character(character));
  hand.update();
  CHECK(hand.tool.said().find("(typed: 1/)") != std::string::npos);
  CHECK(hand.tool.take_character('4'));
  hand.update();
  CHECK(hand.center() == Vec3d{0, 0.25, 0});
  for (int i = 0; i < 3; ++i) CHECK(hand.tool.take_key(259));
  for (const char character : std::string("2*pi")) CHECK(hand.tool.take_character(character));
  CHECK(hand.tool.take_key(key_enter));
  hand.update();
  CHECK(hand.center().y == doctest::Approx(2 * 3.14159265358979));
}

TEST_CASE("Esc and a right click take back what was moved") {
  for (const bool by_mouse : {false, true}) {
    Hand hand;
    const Scene before = hand.scene;
    hand.tool.grab(hand.mouse, hand.selected, hand.scene);
    hand.move(30, 0);
    hand.update();
    CHECK_FALSE(hand.scene == before);
    if (by_mouse)
      hand.press(1);
    else
      hand.tool.cancel();
    hand.update();
    CHECK(hand.scene == before);
    CHECK_FALSE(hand.tool.active());
  }
}

TEST_CASE("a scene that is opened meanwhile is not touched") {
  Hand hand;
  hand.press();
  hand.update();
  hand.move(30, 0);
  hand.update();
  hand.scene.materials[0].name = "of another scene";
  const Scene other = hand.scene;
  hand.move(30, 0);
  hand.update();
  CHECK(hand.scene == other);
}

TEST_CASE("where the middle is not in the picture, handles are where the object was clicked") {
  Hand hand;
  std::get<Sphere<>>(std::get<Solid3d>(hand.scene.objects[0].kind).shape).center = {0, -1000, 0};
  const PictureFrame frame = frame_of(hand.scene, hand.layout.image, 1);
  CHECK(hand.tool.origin(hand.scene, frame, hand.selected) == Vec3d{0, -1000, 0});
  hand.tool.clicked(hand.scene, {0}, {1, -1, 0});
  CHECK(hand.tool.origin(hand.scene, frame, hand.selected) == Vec3d{1, -1, 0});
}

}  // namespace tyndall::test::handle_tool_test
