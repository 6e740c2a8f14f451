#include "app/window/accuracy/views.h"
#include "tests/app/window/driver.h"

namespace tyndall::test::main_window_test {

TEST_CASE("the window: a slider's value goes to the renderer, is undone, and goes back to the file's by two clicks") {
  Driver driver("slider");
  const int before = driver.submits();
  driver.click("gold.fuzz", 0.75);
  CHECK(driver.submits() == before + 1);
  CHECK(driver.value("gold.fuzz") != "0.2");
  driver.key('Z', {.control = true});
  CHECK(driver.value("gold.fuzz") == "0.2");
  driver.click("gold.fuzz", 0.25);
  driver.point("gold.fuzz", 0.25);
  for (int k = 0; k < 2; ++k) driver.press(), driver.release();
  driver.settle();
  CHECK(driver.value("gold.fuzz") == "0.2");
}

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

TEST_CASE("the window: Vary and Key are in the menu of a row") {
  Driver driver("vary");
  driver.click("gold.fuzz", 0.9, 0.5, 1);
  driver.click("gold.fuzz.vary");
  CHECK(driver.has("strip.0"));
  driver.click("strip.0");
  CHECK(driver.value("gold.fuzz") == "0");
  driver.key(256);
  CHECK_FALSE(driver.has("strip.0"));
  driver.click("gold.fuzz", 0.9, 0.5, 1);
  driver.click("gold.fuzz.key");
  CHECK(driver.has("film.track"));
  CHECK(driver.last("message") == "key of Fuzz at frame 0");
}

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

}  // namespace tyndall::test::main_window_test
