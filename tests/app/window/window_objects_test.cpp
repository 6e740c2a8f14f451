#include "core/image/image_io.h"
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
  driver.click_ball();
  REQUIRE(driver.value("picture") == "Ball");
  pull(driver, "x", 100, 30);
  const double moved = driver.number("Ball.center.x");
  CHECK(moved > 0.5);
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
  driver.hold({.shift = true});
  pull(driver, "x", 100, 30);  // a tenth as far
  driver.hold({});
  CHECK(driver.number("Ball.center.x") == doctest::Approx(moved / 10).epsilon(0.03));
  driver.drag(0.2, 0.8, 0.25, 0.8);  // beside the ball
  CHECK(driver.value("camera.look_from.x") != "0");
}

TEST_CASE("the window: G, an axis and a number move the selection; Esc takes a movement back") {
  Driver driver("grab");
  driver.click_ball();
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
  driver.click_ball();
  CHECK(driver.value("picture") == "Ball");
  driver.chord('D');
  CHECK(driver.value("picture") == "Ball 2");
  driver.key(261);
  CHECK(driver.value("picture").empty());
  driver.chord('D');
  CHECK(driver.last("message") == "select an object first: click on it");
  driver.click("picture", 0.2, 0.85, 1);
  driver.click("menu.add_a_lamp");
  CHECK(driver.value("picture") == "Lamp 2");
  driver.key(291);
  driver.type("sun");
  CHECK(driver.value("picture") == "Sun");
  driver.click("Sun.name");
  driver.type("moon");
  CHECK(driver.value("picture") == "Moon");
  driver.key(291);
  driver.write("x");
  driver.escape();
  CHECK(driver.value("picture") == "Moon");
  driver.save();
  const std::vector<Object> saved = load_scene("scene.json").scene.objects;
  REQUIRE(saved.size() == 5);
  CHECK(saved[1].name == "ball");
  CHECK(saved[4].name == "moon");
  for (int k = 0; k < 5; ++k) driver.undo();
  CHECK_FALSE(driver.has("objects.4"));
}

TEST_CASE("the window: Ctrl + click adds to the selection, a second click takes what lies behind") {
  Driver driver("selection");
  driver.click_ball();
  driver.hold({.control = true});
  driver.click("picture", 0.79, 0.4);
  driver.hold({});
  CHECK(driver.value("picture") == "Fog");
  pull(driver, "x", 50, 0);
  CHECK(driver.value("Fog.center.x") != "2");
  driver.escape();
  CHECK(driver.value("picture").empty());
  driver.click_ball();
  CHECK(driver.value("Ball.center.x") != "0");
  driver.undo();
  driver.click("picture", 0.5, 0.55);
  driver.click("picture", 0.5, 0.55);
  CHECK(driver.value("picture") == "Floor");
}

TEST_CASE("the window: a type is chosen from a list, which Esc closes before it takes the selection") {
  Driver driver("types");
  driver.click_ball();
  for (const auto& [list, line] : {std::pair{"Ball.type", "Ball.type.dielectric"}, {"gold.albedo.swatch", ""}}) {
    driver.click(list);
    CHECK(popup_is_open());
    CHECK((*line == '\0' || driver.has(line)));
    driver.escape();
    CHECK_FALSE(popup_is_open());
  }
  CHECK(driver.value("Ball.type") == "metal");
  for (const std::string type : {"lambertian", "fog_within"}) {
    driver.click("Ball.type");
    driver.click("Ball.type." + type);
  }
  CHECK(driver.value("Ball.type") == "fog within");
  CHECK(driver.has("objects.4"));
  driver.undo();
  CHECK_FALSE(driver.has("objects.4"));
  CHECK(driver.value("Ball.type") == "lambertian");
}

TEST_CASE("the window: ten tasks of somebody who sees it for the first time, by what is on the screen") {
  Driver driver("newcomer", [](WindowOptions& options) {
    options.scene = load_scene("showroom");
    options.scene.scene.render.spp = 2;
    options.scene.scene.width = 80, options.scene.scene.height = 50;
  });
  const auto action = [&](const std::string& name) {
    driver.click("tab.actions");
    driver.type(name);
    CHECK(driver.last("did") == name);
  };
  const auto select = [&](const std::string& name, const std::string& number) {
    driver.click("objects." + number);
    CHECK(driver.value("picture") == name);
  };
  select("Glass", "1");  // 1: glass becomes gold
  driver.click("Glass.material");
  driver.click("Glass.material.gold");
  CHECK(driver.value("Glass.material") == "gold");
  select("Ball", "3");  // 2: the ball goes behind the fog
  pull(driver, "z", -90, -90);
  CHECK(driver.number("Ball.center.z") < -0.8);
  driver.click("picture", 0.25, 0.35, 1);  // 3: a lamp is added
  driver.click("menu.add_a_lamp");
  CHECK(driver.value("picture") == "Lamp 2");
  action("this table");  // 4: and focused on, as the table tells
  driver.escape();
  const std::string focus = driver.value("camera.focus_distance");
  driver.hold({.shift = true});
  driver.click("handle.move", 0.5, 0.6);
  driver.hold({});
  CHECK(driver.value("camera.focus_distance") != focus);
  driver.click("render.split.on");  // 5: two settings are compared
  driver.click("render.integrator.path");
  driver.click("render.split.off");
  driver.click("dialog.b");
  CHECK(driver.value("render.integrator.path") == "on");
  driver.click("image.view.noise");  // 6: what is noisy is seen
  CHECK(driver.value("image.view.noise") == "on");
  driver.click("image.view.beauty");
  action("save as");  // 7: saved
  driver.type("mine");
  driver.await("saved", "mine.json");
  driver.set("camera.vfov", "50");  // 8: and come back to
  driver.click("scenes.recent.0");
  driver.await("message", "opened mine.json");
  driver.settle();
  CHECK(driver.value("camera.vfov") != "50");
  for (const auto& [row, pixels] : {std::pair{"render.size.width", "384"}, {"render.size.height", "216"}}) {
    driver.click(row);  // 9: a picture of another size is made
    driver.type(pixels);
  }
  action("snapshot");
  driver.await("saved", "mine-001");
  CHECK(read_image("mine-001.png").width == 384);
  while (driver.last("message") != "nothing to undo") action("undo");  // 10: and all is undone
}

}  // namespace tyndall::test::window_objects_test
