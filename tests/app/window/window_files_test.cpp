#include "core/image/image_io.h"
#include "tests/app/window/driver.h"

#include <tuple>

namespace tyndall::test::window_files_test {

TEST_CASE("the window: files are opened by a typed name, from the list of recent ones, and by the palette") {
  Driver driver("files");
  std::ofstream("two.json") << scene_text;
  driver.chord('O');
  driver.type("two.json");
  driver.await("message", "opened two.json");
  CHECK(driver.platform().title.starts_with("two.json"));
  driver.settle();
  driver.click("scenes.recent.1");
  driver.await("message", "opened scene.json");
  driver.find("quads");
  driver.await("message", "opened quads");
  driver.find("two.json");
  driver.await("message", "opened two.json");
}

TEST_CASE("the window: a name that was typed stays where the scene cannot be saved there") {
  Driver driver("nowhere");
  driver.chord('S', true);
  driver.type("nowhere/quads.json");
  driver.wait_until([&] { return driver.last("message").find("nowhere") != std::string::npos; });
  CHECK(driver.value("dialog.name") == "nowhere/quads.json");
}

/// The first line of the scene's file.
std::string first_line() {
  std::ifstream file("scene.json");
  std::string line;
  std::getline(file, line);
  return line;
}

TEST_CASE("the window: saving asks before a file loses its comments") {
  Driver driver("comments", [](WindowOptions& options) {
    std::ofstream("scene.json") << "// A comment.\n" << scene_text;
    options.scene = load_scene("scene.json");
  });
  for (const bool saves : {false, true}) {
    driver.set("gold.fuzz", "0.25");
    driver.chord('S');
    driver.click(saves ? "dialog.save" : "dialog.cancel");
    driver.wait_until([&] { return (first_line() == "// A comment.") != saves; });
  }
  CHECK(driver.last("saved") == "scene.json");
}

TEST_CASE("the window: closing asks while there are edits, answers come by mouse and by keys, and Save writes") {
  Driver driver("closing");
  driver.set("gold.fuzz", "0.25");
  driver.chord('Q');
  driver.click("gold.fuzz.value");  // the column takes no clicks meanwhile
  CHECK(driver.last("keyboard") == "shortcuts");
  driver.click("dialog.cancel");
  CHECK_FALSE(driver.has("dialog.discard"));
  driver.chord('Q');
  CHECK(driver.has("dialog.discard"));
  driver.escape();
  CHECK_FALSE(driver.has("dialog.discard"));
  driver.chord('Q');
  driver.strike(ImGuiKey_Tab);  // marks the next answer, with Shift the one before
  driver.hold({.shift = true});
  driver.strike(ImGuiKey_Tab);
  driver.hold({});
  driver.strike(ImGuiKey_LeftArrow);  // round and round: Cancel
  driver.strike(ImGuiKey_Enter);
  driver.settle();
  CHECK_FALSE(driver.has("dialog.discard"));
  CHECK(driver.is_open());
  driver.chord('Q');
  driver.push("dialog.save");
  driver.wait_until([&] { return !driver.is_open(); });
  CHECK(std::get<Metal<>>(load_scene("scene.json").scene.materials[1].kind).fuzz == 0.25);
}

TEST_CASE("the window: closing asks nothing where there are no edits") {
  Driver driver("closing_at_once");
  driver.send_key('Q', {.control = true});
  driver.wait_until([&] { return !driver.is_open(); });
}

TEST_CASE(
    "the window: the file is read again when it changes; with edits it is asked about, and not replaced unasked") {
  Driver driver("changed");
  const auto change = [](const std::string& fuzz) {
    std::string text = scene_text;
    std::ofstream("scene.json") << text.replace(text.find("\"fuzz\": 0.2"), 11, "\"fuzz\": " + fuzz);
  };
  const auto answer = [&](const std::string& name) {
    driver.wait_until([&] { return driver.has("dialog." + name); });
    driver.settle();  // it comes to the middle
    driver.click("dialog." + name);
    CHECK_FALSE(driver.has("dialog." + name));
  };
  change("0.3");
  driver.await_value("gold.fuzz", "0.3");
  driver.set("gold.fuzz", "0.6");
  change("0.7");
  answer("keep");
  CHECK(driver.value("gold.fuzz") == "0.6");
  change("0.8");
  answer("take");
  CHECK(driver.value("gold.fuzz") == "0.8");
  change("broken");
  driver.await("message", "scene.json: line 7");
  driver.set("gold.fuzz", "0.61");
  driver.await("message", "scene.json: line 7");  // until it is mended
  driver.chord('S');
  driver.click("dialog.cancel");
  CHECK_THROWS(load_scene("scene.json"));
  driver.chord('S');
  driver.click("dialog.save");
  driver.await("saved", "scene.json");
  CHECK(std::get<Metal<>>(load_scene("scene.json").scene.materials[1].kind).fuzz == 0.61);
  driver.set("gold.fuzz", "0.62");
  CHECK(driver.last("message").find("line 7") == std::string::npos);
  driver.chord('S');
  CHECK_FALSE(driver.has("dialog.save"));
}

TEST_CASE("the window: theme, size of texts, width of the column and folded sections are kept") {
  Driver driver("appearance");
  const auto written = [&](const std::string& line) {
    driver.wait_until([&] {
      std::ifstream file("config/tyndall/window.txt");
      for (std::string found; std::getline(file, found);)
        if (found.starts_with(line)) return true;
      return false;
    });
  };
  const float dark = ImGui::GetStyle().Colors[ImGuiCol_WindowBg].x, usual = driver.width("gold.fuzz.value");
  driver.click("window.theme.light");
  written("theme light");
  CHECK(ImGui::GetStyle().Colors[ImGuiCol_WindowBg].x > dark + 0.5f);
  driver.click("section.Camera");
  written("folded Camera");
  CHECK_FALSE(driver.has("camera.vfov"));
  driver.click("section.Camera");
  CHECK(driver.has("camera.vfov"));
  driver.click("window.text.125");
  written("text-size 1.25");
  CHECK(driver.width("gold.fuzz.value") > usual);
  driver.chord('0');
  written("text-size 1");
  driver.point("column.edge");
  driver.press();
  driver.move(-88, 0);
  driver.release();
  driver.settle();
  written("column 4");
}

TEST_CASE("the window: the clean view is on at a first start") {
  Driver driver("first_start", [](WindowOptions&) { std::filesystem::remove_all("config"); });
  CHECK(driver.value("image.clean.on") == "on");
}

TEST_CASE("the window: a damaged file of preferences is told of, not believed, and moved away if it can be") {
  for (const bool in_the_way : {false, true}) {
    Driver driver("damaged", [&](WindowOptions&) {
      std::ofstream("config/tyndall/window.txt") << "theme light\ncolumn wide\n";
      if (in_the_way) std::filesystem::create_directories("config/tyndall/window.txt.damaged/in the way");
    });
    const std::filesystem::path file = std::filesystem::absolute("config/tyndall/window.txt");
    CHECK(driver.last("message") ==
          file.string() + " is damaged; the window begins with its defaults, " +
              (in_the_way ? "and the file cannot be moved out of the way" : "the file is now window.txt.damaged"));
    CHECK(std::filesystem::exists(file) == in_the_way);
    CHECK(driver.value("window.theme.dark") == "on");
  }
}

TEST_CASE("the window: a picture pauses by itself at an error or a time; an edit or Space goes on") {
  for (const bool by_error : {true, false}) {
    Driver driver("limits", [&](WindowOptions& options) {
      options.scene.scene.render.spp = 1000000;
      (by_error ? options.limits.error : options.limits.seconds) = by_error ? 0.03 : 0.4;  // long enough to be seen
    });
    const auto is = [&](const std::string& state) { driver.await("state", state); };
    is("paused");
    CHECK(driver.last("message").starts_with(by_error ? "paused at the error" : "paused at the time limit"));
    driver.push("gold.fuzz", 0.7);
    is("rendering");
    is("paused");
    driver.send_key(' ');
    is("rendering");
  }
}

TEST_CASE("the window: a reference picture is loaded, refused, of another scene after an edit, and dropped") {
  Driver driver("reference");
  for (const auto& [file, width, height] : {std::tuple{"small.pfm", 10, 6}, {"reference.pfm", 32, 20}})
    write_pfm(file, {width, height, std::vector<float>(static_cast<std::size_t>(3 * width * height), 0.5f)});
  driver.click("chart.reference");
  driver.type("small.pfm");
  driver.await("message", "small.pfm: found 10x6 pixels, expected 32x20 as the picture has");
  driver.escape();
  driver.click("chart.reference");
  driver.type("reference.pfm");
  driver.await("message", "reference: reference.pfm");
  driver.await("accuracy", "against reference.pfm · FLIP 0.");
  driver.key('8');
  driver.await_value("image.view.error", "on");
  CHECK(driver.submits() == 1);
  driver.click("chart.export");
  driver.await("saved", "scene-chart-001");
  driver.set("gold.fuzz", "0.5");
  driver.await("accuracy", "reference of another scene: reference.pfm");
  driver.undo();
  driver.await("accuracy", "against reference.pfm");
  driver.click("chart.reference");
  driver.click("dialog.drop");
  driver.await_value("image.view.beauty", "on");
  driver.await("accuracy", "");
}

}  // namespace tyndall::test::window_files_test
