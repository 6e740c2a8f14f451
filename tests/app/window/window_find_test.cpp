#include "tests/app/window/driver.h"

namespace tyndall::test::window_find_test {

TEST_CASE("the window: a value that is typed where the palette has led to") {
  Driver driver("palette");
  driver.click("section.Render");
  driver.find("roughness");
  driver.type("0.75");
  CHECK(driver.value("gold.fuzz") == "0.75");
  driver.find("bounces");
  driver.type("17");
  CHECK(driver.value("render.max_depth") == "17");
  driver.find("emission");
  CHECK(driver.last("message") == "Power: select a lamp first");
  driver.find("A/B");
  CHECK(driver.value("render.split.on") == "on");
}

TEST_CASE("the window: what is typed into the palette is no shortcut, and without a match it goes on") {
  Driver driver("palette_typing");
  driver.find("nor");
  CHECK(driver.value("image.view.normal") == "on");
  driver.key('K', {.control = true});
  driver.write("1");
  driver.settle();
  CHECK(driver.value("palette") == "1");
  CHECK(driver.value("image.view.normal") == "on");
  driver.type("qqq");
  CHECK(driver.has("palette"));
  driver.escape();
  CHECK_FALSE(driver.has("palette"));
}

TEST_CASE("the window: what the palette adds comes where the mouse was when it opened") {
  Driver driver("palette_add");
  double heights[2] = {};
  for (const int low : {0, 1}) {
    driver.point("picture", low ? 0.2 : 0.5, low ? 0.8 : 0.1);
    driver.find("add a sphere");
    REQUIRE(driver.value("picture") == "Ball 2");
    heights[low] = driver.number("Ball_2.center.y");
    driver.undo();
  }
  CHECK(heights[0] > heights[1] + 0.5);
  driver.key('K', {.control = true});
  driver.write("add lamp");
  driver.settle();
  driver.click("palette.add_a_lamp");
  CHECK(driver.value("picture") == "Lamp 2");
}

TEST_CASE("the window: a type is chosen from a list, which Esc closes before it takes the selection") {
  Driver driver("types");
  driver.click("picture", 0.5, 0.45);
  driver.click("Ball.type");
  CHECK(driver.has("Ball.type.dielectric"));
  driver.escape();
  CHECK_FALSE(driver.has("Ball.type.dielectric"));
  CHECK(driver.value("Ball.type") == "metal");
  driver.click("Ball.type");
  driver.click("Ball.type.fog_within");
  CHECK(driver.value("Ball.type") == "fog within");
  CHECK(driver.has("objects.4"));
  driver.undo();
  CHECK_FALSE(driver.has("objects.4"));
  CHECK(driver.value("Ball.type") == "metal");
}

}  // namespace tyndall::test::window_find_test
