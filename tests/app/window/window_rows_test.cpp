#include "tests/app/window/driver.h"

namespace tyndall::test::window_rows_test {

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

}  // namespace tyndall::test::window_rows_test
