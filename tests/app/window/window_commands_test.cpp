#include "app/window/accuracy/views.h"
#include "tests/app/window/driver.h"

namespace tyndall::test::window_commands_test {

TEST_CASE("the window: exposure needs no new picture") {
  Driver driver("exposure");
  const int before = driver.submits();
  driver.click("image.exposure", 0.7);
  CHECK(driver.value("image.exposure") != "0");
  CHECK(driver.submits() == before);
}

TEST_CASE("the window: a value that is typed where the palette has led to") {
  Driver driver("palette");
  driver.find("roughness");
  driver.type("0.75");
  CHECK(driver.value("gold.fuzz") == "0.75");
  driver.find("density");
  CHECK(driver.last("message") == "Density: select fog first");
}

TEST_CASE("the window: nothing is rendered while nobody sees it, and then what was wanted before") {
  Driver driver("rests");
  for (const bool pauses : {false, true}) {
    if (pauses) driver.key(' ');
    driver.window().rest(true);
    driver.settle();
    CHECK(driver.last("state") == "paused");
    driver.window().rest(false);
    driver.settle();
    CHECK(driver.last("state") == (pauses ? "paused" : "finished"));
  }
}

TEST_CASE("the window: each view comes by its key, or says what it needs") {
  Driver driver("views");
  for (int k = keyed_views - 1; k >= 0; --k) {
    const std::string name = view_entry(k).name;
    driver.key('1' + k);
    CHECK(driver.last("did") == "view: " + name);
    if (shows_errors(k))
      CHECK(driver.last("message") == "load a reference first: see Speed and accuracy");
    else
      CHECK_MESSAGE(driver.value("image.view." + name) == "on", name);
  }
}

}  // namespace tyndall::test::window_commands_test
