#include "tests/app/window/driver.h"

namespace tyndall::test::window_objects_test {

TEST_CASE("the window: objects are added, selected by a click, duplicated and deleted, each a step to undo") {
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
  CHECK(driver.value("menu.add_a_box") == "item");
  driver.click("menu.add_a_box");
  CHECK(driver.value("picture") == "Box");
  for (int k = 0; k < 3; ++k) driver.key('Z', {.control = true});
  CHECK_FALSE(driver.has("objects.2"));
}

}  // namespace tyndall::test::window_objects_test
