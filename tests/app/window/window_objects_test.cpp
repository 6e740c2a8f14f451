#include "core/scene/load.h"
#include "tests/app/window/driver.h"

namespace tyndall::test::window_objects_test {

/// Drags a handle of the selection by window units.
void pull(Driver& driver, const std::string& handle, float right, float down) {
  driver.point("handle." + handle);
  driver.press();
  driver.move(right, down);
  driver.release();
  driver.settle();
}

TEST_CASE("the window: handles move and size what is selected, each pull a step to undo") {
  Driver driver("handles");
  driver.click("picture", 0.5, 0.45);
  REQUIRE(driver.value("picture") == "Ball");
  pull(driver, "x", 100, 30);
  CHECK(driver.number("Ball.center.x") > 0.5);
  CHECK(driver.value("Ball.center.y") == "0.8");
  CHECK(driver.value("camera.look_from.x") == "0");
  driver.undo();
  CHECK(driver.value("Ball.center.x") == "0");
  pull(driver, "move", 60, -60);
  CHECK(driver.number("Ball.center.y") > 1);
  driver.undo();
  CHECK(driver.value("Ball.center.y") == "0.8");
  pull(driver, "size.radius", 40, 40);
  CHECK(driver.number("Ball.radius") > 0.9);
  driver.undo();
  CHECK(driver.value("Ball.radius") == "0.8");
  driver.drag(0.2, 0.8, 0.25, 0.8);  // beside the ball
  CHECK(driver.value("camera.look_from.x") != "0");
}

TEST_CASE("the window: G, an axis and a number move the selection; Esc takes a movement back") {
  Driver driver("grab");
  driver.click("picture", 0.5, 0.45);
  driver.key('G');
  driver.key('X');
  driver.press_characters("1.5");
  driver.key(257);
  CHECK(driver.value("Ball.center.x") == "1.5");
  driver.undo();
  driver.key('G');
  driver.point("picture", 0.6, 0.6);
  CHECK(driver.value("Ball.center.x") != "0");
  driver.escape();
  CHECK(driver.value("Ball.center.x") == "0");
}

TEST_CASE("the window: objects are added, selected by a click, named, duplicated and deleted, each a step to undo") {
  Driver driver("objects");
  driver.click("picture", 0.5, 0.45);
  CHECK(driver.value("picture") == "Ball");
  driver.key('D', {.control = true});
  CHECK(driver.value("picture") == "Ball 2");
  driver.key(261);
  CHECK(driver.value("picture").empty());
  driver.key('D', {.control = true});
  CHECK(driver.last("message") == "select an object first: click on it");
  driver.click("picture", 0.2, 0.85, 1);
  driver.click("menu.add_a_lamp");
  CHECK(driver.value("picture") == "Lamp 2");
  driver.key(291);
  driver.type("sun");
  CHECK(driver.value("picture") == "Sun");
  driver.key('S', {.control = true});
  driver.wait_until([&] { return driver.last("saved") == "scene.json"; });
  const std::vector<Object> saved = load_scene("scene.json").scene.objects;
  REQUIRE(saved.size() == 5);
  CHECK(saved[1].name == "ball");
  CHECK(saved[4].name == "sun");
  for (int k = 0; k < 4; ++k) driver.undo();
  CHECK_FALSE(driver.has("objects.4"));
}

TEST_CASE("the window: Ctrl + click adds to the selection, a second click takes what lies behind") {
  Driver driver("selection");
  driver.click("picture", 0.5, 0.45);
  driver.hold({.control = true});
  driver.click("picture", 0.79, 0.4);
  driver.hold({});
  CHECK(driver.value("picture") == "Fog");
  pull(driver, "x", 50, 0);
  CHECK(driver.value("Fog.center.x") != "2");
  driver.escape();
  CHECK(driver.value("picture").empty());
  driver.click("picture", 0.5, 0.45);
  CHECK(driver.value("Ball.center.x") != "0");
  driver.undo();
  driver.click("picture", 0.5, 0.55);
  driver.click("picture", 0.5, 0.55);
  CHECK(driver.value("picture") == "Floor");
}

}  // namespace tyndall::test::window_objects_test
