#include "app/window/handles/handles.h"
#include "tests/app/window/scenes.h"

namespace tyndall::test::handle_tool_test {

namespace {

constexpr int key_enter = 257, key_backspace = 259;

/// A sphere in the middle of a picture of 400 x 300, selected, and a mouse.
struct Hand {
  HandleTool tool;
  Mouse mouse;
  Scene scene = seen_scene(400, 300, {0, 0, 10}, 60, {ball("ball", {0, 0, 0})});
  Layout layout = make_layout(400, 330, 400, 300, 1, 0);
  ObjectPaths selected{{0}};

  Hand() { mouse.x = 200, mouse.y = 150; }
  bool update() {
    EditedScene edited(std::make_shared<const Scene>(scene));
    const bool taken = tool.update(mouse, layout, 1, true, selected, edited);
    if (auto changed = edited.take()) scene = std::move(*changed);
    mouse.dx = mouse.dy = 0;
    for (bool& button : mouse.clicked) button = false;
    return taken;
  }
  void press(int button = 0) {
    mouse.pressed_x[button] = mouse.x, mouse.pressed_y[button] = mouse.y;
    mouse.clicked[button] = mouse.down[button] = true;
  }
  bool release() {
    mouse.down[0] = false;
    return update();
  }
  bool move(float dx, float dy) {
    mouse.x += dx, mouse.y += dy, mouse.dx = dx, mouse.dy = dy;
    return update();
  }
  /// Whether the tool takes all of these characters.
  bool type(const std::string& text) {
    for (const char c : text)
      if (!tool.take_character(c)) return false;
    return true;
  }
  void grab() { tool.grab(mouse, selected, scene); }
  Vec3d center() const { return shape(scene).center; }
};

}  // namespace

TEST_CASE("a press on a handle that does not move is a click on what lies behind") {
  Hand hand;
  const Scene before = hand.scene;
  hand.press();
  hand.update();
  hand.move(2, 1);
  CHECK(hand.release());
  CHECK(hand.tool.clicked_through());
  CHECK(hand.scene == before);
  CHECK_FALSE(hand.update());
  CHECK_FALSE(hand.tool.clicked_through());
}

TEST_CASE("G moves without a button until a click, whose release is not for others") {
  Hand hand;
  hand.grab();
  CHECK(hand.tool.active());
  CHECK(hand.move(30, 0));
  hand.press();
  CHECK(hand.update());
  CHECK_FALSE(hand.tool.active());
  CHECK(hand.center().x > 1);
  CHECK(hand.update());  // the button is still down
  CHECK_FALSE(hand.release());
}

TEST_CASE("G, then an axis, then a number or a sum and Enter: exactly that far; the same axis again frees it") {
  Hand hand;
  hand.grab();
  CHECK_FALSE(hand.type("1"));  // along no axis
  for (const int key : {'Z', 'Z', 'X'}) CHECK(hand.tool.take_key(key));
  CHECK_FALSE(hand.type("p"));  // no number begins with it
  CHECK(hand.type("-1.57"));
  CHECK(hand.tool.take_key(key_backspace));
  hand.move(30, 10);
  CHECK(hand.tool.said().starts_with("x -1.5"));
  CHECK_FALSE(hand.tool.take_key(256));  // Esc is for the window, which asks to cancel
  CHECK(hand.tool.take_key(key_enter));
  hand.update();
  CHECK(hand.center() == Vec3d{-1.5, 0, 0});
  CHECK_FALSE(hand.tool.take_key('X'));
  Hand sum;
  sum.grab();
  CHECK(sum.tool.take_key('Y'));
  CHECK(sum.type("1/"));
  sum.update();
  CHECK(sum.tool.said().find("(typed: 1/)") != std::string::npos);  // until it is one the mouse decides
  CHECK(sum.type("4"));
  sum.update();
  CHECK(sum.center() == Vec3d{0, 0.25, 0});
  for (int i = 0; i < 3; ++i) CHECK(sum.tool.take_key(key_backspace));
  CHECK(sum.type("2*pi"));
  CHECK(sum.tool.take_key(key_enter));
  sum.update();
  CHECK(sum.center().y == doctest::Approx(2 * 3.14159265358979));
}

TEST_CASE("Esc and a right click take back what was moved; a scene that is opened meanwhile is not touched") {
  for (const bool by_mouse : {false, true}) {
    Hand hand;
    const Scene before = hand.scene;
    hand.grab();
    hand.move(30, 0);
    CHECK_FALSE(hand.scene == before);
    by_mouse ? hand.press(1) : hand.tool.cancel();
    hand.update();
    CHECK(hand.scene == before);
    CHECK_FALSE(hand.tool.active());
  }
  Hand hand;
  hand.press();
  hand.update();
  hand.move(30, 0);
  hand.scene.materials[0].name = "of another scene";
  const Scene other = hand.scene;
  hand.move(30, 0);
  CHECK(hand.scene == other);
}

TEST_CASE("where the middle is not in the picture, handles are where the object was clicked") {
  Hand hand;
  shape(hand.scene).center = {0, -1000, 0};
  const PictureFrame frame = frame_of(hand.scene, hand.layout.image, 1);
  CHECK(hand.tool.origin(hand.scene, frame, hand.selected) == Vec3d{0, -1000, 0});
  hand.tool.clicked(hand.scene, {0}, {1, -1, 0});
  CHECK(hand.tool.origin(hand.scene, frame, hand.selected) == Vec3d{1, -1, 0});
}

}  // namespace tyndall::test::handle_tool_test
