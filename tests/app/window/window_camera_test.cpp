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
  const std::string target = driver.value("camera.look_at.x") + driver.value("camera.look_at.y");
  const auto keeps_target = [&] {
    CHECK(driver.value("camera.look_at.x") + driver.value("camera.look_at.y") == target);
  };
  changes("camera.look_from.x", [&] {
    driver.drag(0.4, 0.5, 0.6, 0.5);
    keeps_target();
  });
  changes("camera.look_at.x", [&] { driver.drag(0.4, 0.5, 0.6, 0.6, 2); });
  changes("camera.look_from.z", [&] {
    driver.drag(0.5, 0.4, 0.6, 0.6, 1);
    keeps_target();
    CHECK(driver.value("camera.look_from.x") == "0");
  });
  driver.point("picture");
  changes("camera.look_from.z", [&] {
    for (int k = 0; k < 3; ++k) driver.wheel(1);
    keeps_target();
  });
  changes("camera.look_from.z", [&] {
    driver.wheel(1);
    const std::string once = driver.value("camera.look_from.z");
    skipped_seconds = skipped_seconds + 1;
    driver.point("picture");
    driver.wheel(1);
    driver.undo();
    CHECK(driver.value("camera.look_from.z") == once);  // steps that are not quick are undone one by one
  });
  driver.hold({.control = true});
  changes("camera.vfov", [&] {
    driver.wheel(1);
    driver.hold({});
    CHECK(driver.value("camera.look_from.z") == "6");
  });
  changes("camera.look_from.z", [&] { driver.fly('W'); });
}

TEST_CASE("the window: the selection is framed, a point is focused on, and Home goes back") {
  Driver driver("frame");
  driver.click_ball();
  driver.key('F');
  CHECK(driver.value("camera.look_at.y") == "0.8");
  driver.escape();
  driver.hold({.shift = true});
  driver.click_ball();
  driver.hold({});
  CHECK(driver.number("camera.focus_distance") > driver.number("camera.look_from.z") - 1.2);
  CHECK(driver.number("camera.focus_distance") < driver.number("camera.look_from.z"));
  driver.key(268);
  CHECK(driver.value("camera.look_at.y") == "0.5");
}

TEST_CASE("the window: cameras are stored, looked through, one after the other, and forgotten") {
  Driver driver("cameras");
  const auto at = [&] { return driver.value("camera.look_from.x"); };
  const std::string home = at();
  driver.click("camera.store");
  CHECK(driver.value("camera.slot.1") == "on");
  driver.drag(0.4, 0.6, 0.6, 0.6);
  const std::string side = at();
  CHECK(side != home);
  CHECK(driver.value("camera.slot.1") == "off");
  driver.find("next stored");  // of a camera that is not stored the first
  CHECK(at() == home);
  driver.undo();
  driver.find("store the camera");
  CHECK(driver.value("camera.slot.2") == "on");
  driver.click("camera.slot.1");
  CHECK(at() == home);
  for (const std::string& next : {side, home, side}) {
    driver.find("next stored");
    CHECK(at() == next);
  }
  driver.undo();
  CHECK(at() == home);
  driver.click("camera.slot.1", 0.5, 0.5, 1);
  CHECK_FALSE(driver.has("camera.slot.2"));
}

TEST_CASE("the window: rendered and saved as a snapshot at the window's size, while the file keeps its own") {
  Driver driver("at_window");
  driver.key('I');
  driver.click("render.at.window");
  driver.point("picture", 0.99, 0.99);
  driver.await_value("inspector", "pixel    89");
  driver.click_ball();
  CHECK(driver.value("picture") == "Ball");
  driver.chord('P');
  driver.await("saved", "scene-001");
  CHECK(load_scene("scene-001.png").scene.width > 800);
  driver.save();
  CHECK(load_scene("scene.json").scene.width == 32);
  driver.click("render.at.file");
  driver.point("picture", 0.99, 0.99);
  driver.await_value("inspector", "pixel    31");
}

}  // namespace tyndall::test::window_camera_test
