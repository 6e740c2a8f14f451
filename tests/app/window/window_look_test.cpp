#include "tests/app/window/driver.h"

namespace tyndall::test::window_look_test {

bool says(const Driver& driver, const std::string& control, const std::string& words) {
  return driver.value(control).find(words) != std::string::npos;
}

TEST_CASE("the window: the inspector tells of the pixel under the mouse") {
  Driver driver("inspector");
  driver.key('I');
  driver.point("picture", 0.5, 0.45);
  driver.wait_until([&] { return says(driver, "inspector", "object   Ball"); });
  for (const std::string words : {"samples  2", "material gold", "red      ", "± ", "shown    "})
    driver.wait_until([&] { return says(driver, "inspector", words); });
  driver.point("picture", 0.05, 0.05);
  driver.wait_until([&] { return says(driver, "inspector", "object   nothing"); });
  driver.escape();
  CHECK_FALSE(driver.has("inspector"));
}

TEST_CASE("the window: the path of a noisy pixel follows the camera, until an edit changes what it met") {
  Driver driver("path");
  driver.point("picture", 0.5, 0.45);
  driver.key('I', {.shift = true});
  driver.wait_until([&] { return says(driver, "path.1", "ball"); });
  driver.wait_until([&] { return says(driver, "inspector", "the brightest of 2 samples: "); });
  const float before = driver.left("path.1");
  driver.drag(0.4, 0.8, 0.45, 0.8);
  CHECK(driver.left("path.1") != before);
  driver.click("gold.fuzz", 0.8);
  CHECK_FALSE(driver.has("path.1"));
}

TEST_CASE("the window: enlarging the picture edits nothing, and clicks still meet what is under the mouse") {
  Driver driver("zoom");
  const float fitting = driver.width("picture");
  driver.key('0');
  CHECK(driver.width("picture") == doctest::Approx(32).epsilon(0.05));
  driver.point("picture");
  driver.hold({.alt = true});
  for (int k = 0; k < 12; ++k) driver.wheel(1);
  CHECK(driver.width("picture") > 400);
  driver.drag(0.5, 0.5, 0.6, 0.6);
  driver.hold({});
  driver.click("picture", 0.5, 0.45);
  CHECK(driver.value("picture") == "Ball");
  CHECK(driver.submits() == 1);
  driver.escape();
  driver.key('0');
  driver.key('0');
  CHECK(driver.width("picture") == doctest::Approx(fitting).epsilon(0.01));
}

TEST_CASE("the window: legends tell what colours mean") {
  Driver driver("legends");
  const std::pair<const char*, const char*> views[] = {{"samples", "samples: 0 "},
                                                       {"noise", "estimated relative error: 0 % 50 % 100 %"},
                                                       {"false", "stops from middle grey: -6 -5 -4 -3 -2 -1 0"},
                                                       {"cost", "rays of a path: 0 "}};
  for (const auto& [view, legend] : views) {
    driver.find(std::string("view ") + view);
    driver.wait_until([&, expected = legend] { return says(driver, "legend", expected); });
  }
  driver.find("view object");
  CHECK(driver.value("image.view.object") == "on");
  driver.wait_until([&] { return !driver.has("legend"); });
  driver.click("section.Histogram");
  driver.wait_until([&] { return says(driver, "histogram", "white, clipped: "); });
}

TEST_CASE("the window: a rectangle is refined first, and later the rest") {
  Driver driver("refine");
  driver.key('B', {.control = true});
  driver.drag(0.4, 0.4, 0.6, 0.6);
  CHECK(says(driver, "rectangle", "refined first"));
  driver.key('B', {.control = true});
  CHECK_FALSE(driver.has("rectangle"));
}

TEST_CASE("the window: the raw and the clean picture side by side, with both errors") {
  Driver driver("clean");
  driver.key('N');
  CHECK(driver.value("image.clean.on") == "on");
  driver.key('N', {.shift = true});
  driver.wait_until([&] { return says(driver, "split.b", "clean   2 spp   est. error"); });
  driver.wait_until([&] { return driver.value("split.a").starts_with("raw   2 spp   est. error"); });
  driver.click("image.clean.off");
  CHECK_FALSE(driver.has("divider"));
  CHECK(driver.submits() == 1);
}

}  // namespace tyndall::test::window_look_test
