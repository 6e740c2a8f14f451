#include "tests/app/window/panels/column.h"

namespace tyndall::test::column_test {

TEST_CASE("a new user finds fuzz, refractive index and density at once") {
  const TestColumn column;
  for (const char* name : {"gold.fuzz", "glass.refractive_index", "Fog.density", "Fog.g", "Ball.radius", "camera.vfov",
                           "image.exposure", "render.max_depth", "chart", "scenes.cover"})
    CHECK_MESSAGE(column.has(name), name);
}

TEST_CASE("a tab brings its part to the head of the column, opens it, and is lit; so does a selection") {
  TestColumn column;
  column.height = 500;
  column.draw(2);
  for (const std::string name : {"Render", "Image", "Camera"}) {
    column.ui.folded.insert(name);
    column.draw();
    column.click("tab." + name);
    column.draw(2);
    CHECK_FALSE(column.ui.folded.contains(name));
    REQUIRE(column.has("section." + name));
    CHECK(column.rect("section." + name).y0 < 90);
    CHECK(column.lit() == name);
  }
  column.click("tab.Scenes");  // the last part cannot reach the head
  column.draw(2);
  CHECK(column.has("scenes.showroom"));
  CHECK(column.lit() == "Scenes");
  CHECK_FALSE(column.has("Ball.name"));
  column.ui.folded.insert("Ball");
  column.select({0});
  CHECK(column.has("section.Ball"));
  CHECK(column.has("Ball.type"));
  CHECK(column.state.tabs.lit == 0);
}

TEST_CASE("dragging its edge makes the column wider, within limits, and a double click sets it back") {
  TestColumn column;
  column.aim("column.edge");
  column.button(true);
  column.move_mouse(-60, 100);
  CHECK(column.look.column == 432);
  column.move_mouse(300, 100);
  CHECK(column.look.column == narrowest_column);
  column.button(false);
  column.click_twice("column.edge");
  CHECK(column.look.column == column_width);
}

TEST_CASE("the list of scenes wants the pictures that are seen") {
  TestColumn column;
  column.state.now.recent = {"/scenes/my own.json"};
  column.draw(2);
  CHECK(column.state.wanted_pictures == std::vector<std::string>{"showroom", "cover", "/scenes/my own.json"});
}

TEST_CASE("the column can be drawn at any size, over an empty scene too") {
  TestColumn column;
  column.scene() = {};
  NullImGui small(64, 64);
  Ui ui;
  for (const Rect& rect : {Rect{0, 0, 20, 10}, Rect{0, 0, 100, 50}, Rect{0, 0, 0, 0}, Rect{0, 0, 372, 400}})
    for (int k = 0; k < 2; ++k) small.frame([&] { draw_column(ui, column.state, rect); });
  CHECK(ui.problem.empty());
}

TEST_CASE("a click in the list of objects selects one and shows its values, a second click on it selects nothing") {
  TestColumn column;
  column.click("objects.1");
  CHECK(column.state.selected == ObjectPath{1});
  for (const char* name : {"glass.refractive_index", "Bubble.center.x", "Bubble.radius", "Bubble.transform0"})
    CHECK_MESSAGE(column.has(name), name);
  for (const char* name : {"gold.fuzz", "Bubble.center_end.x"}) CHECK_FALSE_MESSAGE(column.has(name), name);
  column.click("objects.1");
  CHECK(column.state.selected.empty());
}

namespace {

/// The column over a sphere, a group of 30 small ones, and a group of two.
struct ManyObjects : TestColumn {
  ManyObjects() {
    std::vector<Object> many(30, ball("", {0, 0, 0}, 1, 1));
    many[29].name = "pearl";
    scene().objects = {ball("ball", {0, 0, 0}), {"beads", Group{many}, {}}, {"pair", Group{{many[0], many[1]}}, {}}};
    draw(2);
  }
  void search(const char* text) {
    state.objects.search = text;
    draw(2);
  }
};

}  // namespace

TEST_CASE("large groups are folded at first, small ones are not, and a click on the sign turns that") {
  ManyObjects column;
  CHECK(column.has("objects.4"));  // sphere, beads, pair, and the two of the pair
  CHECK_FALSE(column.has("objects.5"));
  column.click("objects.1", 0.03);
  CHECK(column.has("objects.5"));
  CHECK(column.state.selected.empty());
  column.click("objects.1", 0.5);
  CHECK(column.state.selected == ObjectPath{1});
}

TEST_CASE("what is selected elsewhere is unfolded and shown in the list") {
  ManyObjects column;
  column.select({1, 29});
  CHECK(column.has("objects.31"));
}

TEST_CASE("a search finds objects in folded groups, by name, kind and material") {
  ManyObjects column;
  column.search("PEARL");
  CHECK_FALSE(column.has("objects.1"));
  column.click("objects.0");
  CHECK(column.state.selected == ObjectPath{1, 29});
  column.search("gold");
  column.click("objects.0");
  CHECK(column.state.selected == ObjectPath{0});
}

TEST_CASE("Ctrl + click adds to the selection and takes away again") {
  ManyObjects column;
  column.click("objects.0");
  ImGui::GetIO().KeyCtrl = true;
  column.click("objects.2");
  CHECK(all_selected(column.state) == std::vector<ObjectPath>{{2}, {0}});
  column.click("objects.0");
  CHECK(all_selected(column.state) == std::vector<ObjectPath>{{2}});
}

TEST_CASE("the wheel scrolls the list under the mouse; at its end, and where it was turned before, the column") {
  ManyObjects column;
  column.click("objects.1", 0.03);  // more lines than the list is high
  column.height = 900;
  column.draw(3);
  const auto roll = [&](float notches) {
    ImGui::GetIO().MouseWheel = notches;
    column.draw(2);
  };
  column.move_mouse(200, 100);
  for (int k = 0; k < 40; ++k) roll(-1);  // to the end of the column
  REQUIRE(column.has("objects.1"));
  const Rect before = column.rect("objects.1");
  column.aim("objects.1");
  roll(1);  // a moment ago the column was scrolled, so it still is
  CHECK(column.rect("objects.1").y0 > before.y0);
  roll(-1);
  column.draw(40);
  column.aim("objects.1");
  roll(-1);  // now it is the list
  CHECK_FALSE(column.has("objects.1"));
  roll(1);  // back to the list's start
  REQUIRE(column.has("objects.1"));
  CHECK(column.rect("objects.1") == before);
  roll(1);  // and on with the column
  CHECK(column.rect("objects.1").y0 > before.y0);
}

}  // namespace tyndall::test::column_test
