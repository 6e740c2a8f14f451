#include "app/window/accuracy/views.h"
#include "tests/app/window/driver.h"

namespace tyndall::test::window_commands_test {

/// What is to be seen of a command that does more than the log says of each.
const std::map<std::string, bool (*)(const Driver&)> effects = {
    {"deselect", [](const Driver& d) { return !d.has("Ball.name"); }},
    {"add an object", [](const Driver& d) { return d.has("menu.add_a_sphere"); }},
    {"duplicate", [](const Driver& d) { return d.value("picture") == "Ball 2"; }},
    {"delete", [](const Driver& d) { return !d.has("Ball.name"); }},
    {"rename", [](const Driver& d) { return d.value("Ball.name").ends_with("typing"); }},
    {"add a sphere", [](const Driver& d) { return d.value("picture") == "Ball 2"; }},
    {"add a hollow ball", [](const Driver& d) { return d.value("picture").starts_with("Shell"); }},
    {"add a box", [](const Driver& d) { return d.value("picture") == "Box"; }},
    {"add a quad", [](const Driver& d) { return d.value("picture") == "Quad"; }},
    {"add a triangle", [](const Driver& d) { return d.value("picture") == "Triangle"; }},
    {"add a disk", [](const Driver& d) { return d.value("picture") == "Disk"; }},
    {"add a lamp", [](const Driver& d) { return d.value("picture") == "Lamp 2"; }},
    {"add fog", [](const Driver& d) { return d.value("picture") == "Fog 2"; }},
    {"pause or go on", [](const Driver& d) { return d.last("state") != "rendering"; }},
    {"save the scene", [](const Driver& d) { return d.has("dialog.save") || d.last("saved") == "scene.json"; }},
    {"open a file", [](const Driver& d) { return d.has("dialog.open"); }},
    {"save as", [](const Driver& d) { return d.has("dialog.name"); }},
    {"snapshot", [](const Driver& d) { return d.last("saved").find("scene-") != std::string::npos; }},
    {"clean view on or off", [](const Driver& d) { return d.value("image.clean.off") == "off"; }},
    {"clean beside raw", [](const Driver& d) { return d.value("image.clean.beside_raw") == "on"; }},
    {"hide the panels", [](const Driver& d) { return !d.has("tab.Object"); }},
    {"larger text", [](const Driver& d) { return d.value("window.text.100") == "off"; }},
    {"smaller text", [](const Driver& d) { return d.value("window.text.100") == "off"; }},
    {"inspect pixels", [](const Driver& d) { return d.has("inspector"); }},
    {"why noisy", [](const Driver& d) { return d.has("path.1"); }},
    {"actual size", [](const Driver& d) { return d.has("zoom"); }},
    {"refine a rectangle first", [](const Driver& d) { return d.last("message").starts_with("drag over"); }},
    {"store the camera", [](const Driver& d) { return d.value("camera.slot.1") == "on"; }},
    {"split view", [](const Driver& d) { return d.has("split.b"); }},
    {"reference picture", [](const Driver& d) { return d.has("dialog.load"); }},
    {"export the chart", [](const Driver& d) { return d.last("saved").find("scene-") != std::string::npos; }},
    {"dark or light theme", [](const Driver& d) { return d.value("window.theme.light") == "on"; }},
    {"this table", [](const Driver& d) { return d.last("help") == "open"; }}};

/// The ball is selected, nothing is open, the mouse is over the floor.
void begin(Driver& driver) {
  for (int k = 0; k < 4; ++k) driver.escape();
  if (!driver.has("tab.Object")) driver.key(258);
  if (driver.has("zoom")) driver.key('0');
  if (driver.value("image.clean.off") != "on") driver.click("image.clean.off");
  if (driver.has("split.b")) driver.find("split view");
  if (driver.value("window.theme.dark") != "on") driver.click("window.theme.dark");
  driver.chord('0');  // the usual text
  for (int k = 0; k < 5 && driver.has("objects.4"); ++k) driver.undo();
  if (!driver.has("objects.3")) driver.undo();
  driver.escape();
  driver.click("objects.1");
  REQUIRE_MESSAGE(driver.value("picture") == "Ball", driver.last("did"));
  driver.point("picture", 0.2, 0.85);
}

void check(Driver& driver, const Command& command) {
  CAPTURE(command.name);
  CHECK(driver.last("did") == command.name);
  const auto effect = effects.find(command.name);
  if (effect != effects.end()) driver.wait_until([&] { return effect->second(driver); });
}

TEST_CASE("the window: each command by its key and by the palette") {
  Driver driver("commands");
  driver.click("section.Render");  // so that all of the column is on the screen with larger texts, too
  for (const Command& command : commands()) {
    if (command.is(unlisted) || command.name == "close the window" || command.name == "all actions by name") continue;
    for (const bool by_palette : {false, true}) {
      if (!by_palette && command.key.code == 0) continue;
      begin(driver);
      if (by_palette)
        driver.find(command.name);
      else
        driver.key(command.key.code, {.control = command.key.control, .shift = command.key.shift});
      check(driver, command);
    }
  }
}

TEST_CASE("the window: commands in the menus of Insert and of a right click") {
  Driver driver("menus");
  for (const char* name : {"add a box", "add a lamp"}) {
    begin(driver);
    driver.key(260);
    driver.click("menu." + log_name(name));
    check(driver, command_named(name));
  }
  for (const char* name : {"duplicate", "delete", "rename"}) {
    begin(driver);
    driver.click("picture", 0.5, 0.45, 1);
    driver.click("menu." + log_name(name));
    check(driver, command_named(name));
  }
}

TEST_CASE("the window: nothing is rendered while nobody sees it, and then what was wanted before") {
  Driver driver("rests");
  driver.settle();
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

TEST_CASE("the window: what changes no picture starts nothing over, but can be undone") {
  Driver driver("nothing_restarts");
  driver.click("image.tone_map.aces");
  driver.click("image.exposure", 0.7);
  CHECK(driver.value("image.exposure") != "0");
  driver.undo();
  CHECK(driver.value("image.exposure") == "0");
  driver.set("gold.fuzz", "0.2");
  driver.set("gold.fuzz", "0.200");
  driver.set("gold.fuzz", "1.5");
  CHECK(driver.last("message") == "fuzz: found 1.5, expected a number in [0, 1]");
  CHECK(driver.value("gold.fuzz") == "0.2");
  CHECK(driver.submits() == 1);
}

TEST_CASE("the window: the palette leads to rows and commands, or says what to do first") {
  Driver driver("palette");
  driver.click("section.Render");
  driver.find("bounces");
  driver.type("17");
  CHECK(driver.value("render.max_depth") == "17");
  driver.find("emission");
  CHECK(driver.last("message") == "Power: select a lamp first");
  driver.find("A/B");
  CHECK(driver.value("render.split.on") == "on");
}

TEST_CASE("the window: what is typed into the palette is no shortcut, goes on without a match, and is forgotten") {
  Driver driver("palette_typing");
  const auto begin = [&](const char* text) {
    driver.chord('K');
    driver.write(text);
    driver.settle();
  };
  driver.find("nor");
  CHECK(driver.value("image.view.normal") == "on");
  begin("1");
  CHECK(driver.value("palette") == "1");
  CHECK(driver.value("image.view.normal") == "on");
  driver.type("sabe");  // there is no such thing
  CHECK(driver.has("palette"));
  driver.strike(ImGuiKey_Backspace, 2);
  driver.write("xx");
  driver.click("palette", 0.5, 0.5);
  REQUIRE(driver.has("palette"));
  driver.strike(ImGuiKey_Backspace, 2);
  driver.write("ve");
  driver.key(264);  // down, to the second line
  driver.strike(ImGuiKey_Enter);
  driver.settle();
  CHECK(driver.last("did") == "save as");
  driver.escape();
  begin("tone");
  driver.click("picture", 0.05, 0.95);  // beside it
  CHECK_FALSE(driver.has("palette"));
  begin("");
  driver.hold({.control = true});
  driver.strike(ImGuiKey_Z);
  driver.strike(ImGuiKey_Y);
  driver.hold({});
  driver.settle();
  CHECK(driver.value("palette").empty());
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
  driver.chord('K');
  driver.write("add lamp");
  driver.settle();
  driver.click("palette.add_a_lamp");
  CHECK(driver.value("picture") == "Lamp 2");
}

}  // namespace tyndall::test::window_commands_test
