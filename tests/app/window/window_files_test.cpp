#include "core/image/image_io.h"
#include "tests/app/window/driver.h"

#include <tuple>

namespace tyndall::test::window_files_test {

TEST_CASE("the window: files are opened by a typed name, from the list of recent ones, and by the palette") {
  Driver driver("files");
  std::ofstream("two.json") << scene_text;
  const auto opens = [&](const std::string& title) {
    driver.wait_until([&] { return driver.last("message") == "opened " + title; });
  };
  driver.key('O', {.control = true});
  driver.type("two.json");
  opens("two.json");
  driver.settle();
  driver.click("scenes.recent.1");
  opens("scene.json");
  driver.find("quads");
  opens("quads");
  driver.find("two.json");
  opens("two.json");
}

TEST_CASE("the window: a name that was typed stays where the scene cannot be saved there") {
  Driver driver("nowhere");
  driver.key('S', {.control = true, .shift = true});
  driver.type("nowhere/quads.json");
  driver.wait_until([&] { return driver.last("message").find("nowhere") != std::string::npos; });
  CHECK(driver.value("dialog.name") == "nowhere/quads.json");
}

TEST_CASE("the window: saving asks before a file loses its comments") {
  Driver driver("comments", [](WindowOptions& options) {
    std::ofstream("scene.json") << "// A comment.\n" << scene_text;
    options.scene = load_scene("scene.json");
  });
  const auto has_comment = [] {
    std::ifstream file("scene.json");
    std::string first;
    return std::getline(file, first) && first == "// A comment.";
  };
  for (const bool saves : {false, true}) {
    driver.set("gold.fuzz", "0.25");
    driver.key('S', {.control = true});
    driver.click(saves ? "dialog.save" : "dialog.cancel");
    driver.wait_until([&] { return has_comment() != saves; });
  }
  CHECK(driver.last("saved") == "scene.json");
}

TEST_CASE("the window: tabs bring parts of the column to the head of a low window") {
  Driver driver("tabs");
  driver.platform().height = 640;
  driver.settle();
  for (const std::string part : {"Scenes", "Objects", "Render", "Camera", "Image", "Object"}) {
    driver.click("tab." + part);
    driver.wait_until([&] { return driver.value("tab." + part) == "on"; });
  }
  driver.click("tab.Objects");
  driver.click("picture", 0.5, 0.45);
  driver.wait_until([&] { return driver.value("tab.Object") == "on"; });
  CHECK(driver.has("section.Ball"));
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
  driver.key('+', {.control = true});
  written("text-size 1.1");
  CHECK(driver.width("gold.fuzz.value") > usual);
  driver.key('0', {.control = true});
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

TEST_CASE("the window: a damaged file of preferences is told of, and not believed") {
  Driver driver("damaged",
                [](WindowOptions&) { std::ofstream("config/tyndall/window.txt") << "theme light\ncolumn wide\n"; });
  CHECK(driver.last("message").find("window.txt is damaged") != std::string::npos);
  CHECK(driver.value("window.theme.dark") == "on");
  CHECK(std::filesystem::exists("config/tyndall/window.txt.damaged"));
}

TEST_CASE("the window: a picture pauses by itself at an error or a time; an edit or Space goes on") {
  for (const bool by_error : {true, false}) {
    Driver driver("limits", [&](WindowOptions& options) {
      options.scene.scene.render.spp = 1000000;
      (by_error ? options.limits.error : options.limits.seconds) = 0.4;
    });
    const auto is = [&](const std::string& state) { driver.wait_until([&] { return driver.last("state") == state; }); };
    is("paused");
    CHECK(driver.last("message").starts_with(by_error ? "paused at the error" : "paused at the time limit"));
    driver.push("gold.fuzz", 0.7);
    is("rendering");
    is("paused");
    driver.send_key(' ');
    is("rendering");
  }
}

TEST_CASE("the window: names that hold anything stand in one line, in the title, too") {
  const std::string odd = "line\nfeed \x01\x1b[31m %s ## ###";
  Driver driver("odd_names", [&](WindowOptions& options) {
    options.scene.source = options.scene.name = "odd\n\x1b[31m %s ##x.json";
    options.scene.scene.objects[1].name = odd;
  });
  driver.click("picture", 0.5, 0.45);
  CHECK(driver.value("picture") == "Line\\nfeed \\u0001\\u001b[31m %s ## ###");
  CHECK(driver.platform().title.find('\n') == std::string::npos);
  CHECK(driver.platform().title.find("odd\\n\\u001b[31m %s ##x.json") == 0);
}

TEST_CASE("the window: a reference picture is loaded, refused, of another scene after an edit, and dropped") {
  Driver driver("reference");
  const auto says = [&](const char* kind, const std::string& text) {
    driver.wait_until([&] { return driver.last(kind).starts_with(text); });
  };
  for (const auto& [file, width, height] : {std::tuple{"small.pfm", 10, 6}, {"reference.pfm", 32, 20}})
    write_pfm(file, {width, height, std::vector<float>(static_cast<std::size_t>(3 * width * height), 0.5f)});
  driver.click("chart.reference");
  driver.type("small.pfm");
  says("message", "small.pfm: found 10x6 pixels, expected 32x20 as the picture has");
  driver.escape();
  driver.click("chart.reference");
  driver.type("reference.pfm");
  says("message", "reference: reference.pfm");
  says("accuracy", "against reference.pfm · FLIP 0.");
  driver.key('8');
  driver.wait_until([&] { return driver.value("image.view.error") == "on"; });
  CHECK(driver.submits() == 1);
  driver.set("gold.fuzz", "0.5");
  says("accuracy", "reference of another scene: reference.pfm");
  driver.undo();
  says("accuracy", "against reference.pfm");
  driver.click("chart.reference");
  driver.click("dialog.drop");
  driver.wait_until([&] { return driver.value("image.view.beauty") == "on" && driver.last("accuracy").empty(); });
}

}  // namespace tyndall::test::window_files_test
