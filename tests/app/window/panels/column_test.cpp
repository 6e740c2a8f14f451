#include "tests/app/window/panels/column.h"

namespace tyndall::test::column_test {

namespace {

/// The part of the column under its tabs.
Rect heading(const TestColumn& column, const std::string& section) { return column.rect("section." + section); }

}  // namespace

TEST_CASE("a tab brings its part to the head of the column, opens it, and is lit") {
  TestColumn column;
  column.height = 500;
  column.draw();
  column.draw();
  for (const char* name : {"Render", "Image", "Camera"}) {
    column.ui.folded.insert(name);
    column.draw();
    column.click(std::string("tab.") + name);
    column.draw();
    column.draw();
    CHECK_FALSE(column.ui.folded.contains(name));
    REQUIRE(column.has(std::string("section.") + name));
    CHECK(heading(column, name).y0 < 90);
    CHECK(column_sections()[static_cast<std::size_t>(column.state.tabs.lit)].name == std::string(name));
  }
  column.click("tab.Scenes");  // the last part cannot reach the head
  column.draw();
  column.draw();
  CHECK(column.has("scenes.showroom"));
  CHECK(column_sections()[static_cast<std::size_t>(column.state.tabs.lit)].name == std::string("Scenes"));
}

TEST_CASE("selecting an object in the picture brings its values to the head of the column") {
  TestColumn column;
  column.height = 500;
  column.click("tab.Objects");
  column.draw();
  column.draw();
  CHECK_FALSE(column.has("Ball.name"));
  column.ui.folded.insert("Ball");
  column.state.selected = {0};
  for (int k = 0; k < 3; ++k) column.draw();
  CHECK(column.has("section.Ball"));
  CHECK(column.has("Ball.type"));
  CHECK(column.state.tabs.lit == 0);
}

TEST_CASE("the tab at the end asks for all actions") {
  TestColumn column;
  column.aim("tab.actions");
  column.button(true);
  column.button(false);
  CHECK(column.has_query_for({"all actions by name"}));
}

TEST_CASE("dragging its edge makes the column wider, within limits, and a double click sets it back") {
  TestColumn column;
  column.aim("column.edge");
  column.button(true);
  compat::mouse_pos(ImGui::GetIO(), -60, 100);
  column.draw();
  CHECK(column.look.column == 432);
  compat::mouse_pos(ImGui::GetIO(), 300, 100);
  column.draw();
  CHECK(column.look.column == narrowest_column);
  column.button(false);
  column.click_twice("column.edge");
  CHECK(column.look.column == column_width);
}

TEST_CASE("the list of scenes shows which method fails, wants the pictures that are seen, and opens recent files") {
  TestColumn column;
  column.state.now.recent = {"/scenes/my own.json"};
  column.draw();
  column.draw();
  CHECK(column.state.wanted_pictures == std::vector<std::string>{"showroom", "cover", "/scenes/my own.json"});
  column.click("scenes.recent.0");
  CHECK(column.requested.back() == Request{"scene", "/scenes/my own.json"});
  column.click("scenes.cover");
  CHECK(column.requested.back() == Request{"scene", "cover"});
}

TEST_CASE("theme and text size are chosen in the column") {
  TestColumn column;
  column.click("window.theme.light");
  CHECK(column.look.theme == Theme::light);
  column.click("window.text.125");
  CHECK(column.look.text_size == 1.25);
}

}  // namespace tyndall::test::column_test
