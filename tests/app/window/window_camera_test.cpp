#include "tests/app/window/driver.h"

namespace tyndall::test::window_camera_test {

TEST_CASE("the window: the mouse orbits, pans and moves the camera, each a step to undo") {
  Driver driver("camera");
  const auto changes = [&](const std::string& control, const std::function<void()>& act) {
    const std::string before = driver.value(control);
    act();
    CHECK_MESSAGE(driver.value(control) != before, control);
    driver.undo();
    CHECK_MESSAGE(driver.value(control) == before, control);
  };
  changes("camera.look_from.x", [&] {
    driver.drag(0.4, 0.5, 0.6, 0.5);
    CHECK(driver.value("camera.look_at.x") == "0");
  });
  changes("camera.look_at.x", [&] { driver.drag(0.4, 0.5, 0.6, 0.6, 2); });
  changes("camera.look_from.z", [&] { driver.drag(0.5, 0.4, 0.5, 0.6, 1); });
  driver.point("picture");
  changes("camera.look_from.z", [&] {
    for (int k = 0; k < 3; ++k) driver.wheel(1);
  });
  changes("camera.vfov", [&] {
    driver.hold({.control = true});
    driver.wheel(1);
    driver.hold({});
  });
  changes("camera.look_from.z", [&] { driver.fly('W'); });
}

TEST_CASE("the window: the selection is framed, a point is focused on, and Home goes back") {
  Driver driver("frame");
  driver.click("picture", 0.5, 0.45);
  driver.key('F');
  CHECK(driver.value("camera.look_at.y") == "0.8");
  driver.escape();
  driver.hold({.shift = true});
  driver.click("picture", 0.5, 0.45);
  driver.hold({});
  CHECK(driver.number("camera.focus_distance") > driver.number("camera.look_from.z") - 1.2);
  CHECK(driver.number("camera.focus_distance") < driver.number("camera.look_from.z"));
  driver.key(268);
  CHECK(driver.value("camera.look_at.y") == "0.5");
}

TEST_CASE("the window: cameras are stored, looked through and forgotten") {
  Driver driver("cameras");
  const std::string home = driver.value("camera.look_from.x");
  driver.click("camera.store");
  CHECK(driver.value("camera.slot.1") == "on");
  driver.drag(0.4, 0.6, 0.6, 0.6);
  const std::string side = driver.value("camera.look_from.x");
  CHECK(side != home);
  CHECK(driver.value("camera.slot.1") == "off");
  driver.find("store the camera");
  CHECK(driver.value("camera.slot.2") == "on");
  driver.click("camera.slot.1");
  CHECK(driver.value("camera.look_from.x") == home);
  driver.find("next stored");
  CHECK(driver.value("camera.look_from.x") == side);
  driver.undo();
  CHECK(driver.value("camera.look_from.x") == home);
  driver.undo();
  CHECK(driver.value("camera.look_from.x") == side);
  driver.click("camera.slot.1", 0.5, 0.5, 1);
  CHECK_FALSE(driver.has("camera.slot.2"));
}

TEST_CASE("the window: rendered at the window's size, the file keeps its own") {
  Driver driver("at_window");
  driver.key('I');
  driver.click("render.at.window");
  driver.point("picture", 0.99, 0.99);
  driver.wait_until([&] { return driver.value("inspector").find("pixel    89") != std::string::npos; });
  driver.click("picture", 0.5, 0.45);
  CHECK(driver.value("picture") == "Ball");
  driver.key('S', {.control = true});
  driver.wait_until([&] { return driver.last("saved") == "scene.json"; });
  CHECK(load_scene("scene.json").scene.width == 32);
}

}  // namespace tyndall::test::window_camera_test
