#include "tests/app/window/panels/column.h"

namespace tyndall::test::objects_panel_test {

namespace {

/// A sphere, a group of 30 small ones, and a group of two.
void fill(TestColumn& column) {
  std::vector<Object> many(30, Object{"", Solid3d{Sphere<>{}, 1}, {}});
  many[29].name = "pearl";
  column.scene().objects = {
      {"ball", Solid3d{Sphere<>{}, 0}, {}}, {"beads", Group{many}, {}}, {"pair", Group{{many[0], many[1]}}, {}}};
  column.draw();
  column.draw();
}

}  // namespace

TEST_CASE("large groups are folded at first, small ones are not, and a click on the sign turns that") {
  TestColumn column;
  fill(column);
  CHECK(column.has("objects.4"));  // sphere, beads, pair, and the two of the pair
  CHECK_FALSE(column.has("objects.5"));
  column.click("objects.1", 0.03);
  CHECK(column.has("objects.5"));
  CHECK(column.state.selected.empty());
  column.click("objects.1", 0.5);
  CHECK(column.state.selected == ObjectPath{1});
}

TEST_CASE("a search finds objects in folded groups, by name, kind and material") {
  TestColumn column;
  fill(column);
  column.state.objects.search = "PEARL";
  column.draw();
  column.draw();
  CHECK_FALSE(column.has("objects.1"));
  column.click("objects.0");
  CHECK(column.state.selected == ObjectPath{1, 29});
  column.state.objects.search = "gold";
  column.draw();
  column.draw();
  column.click("objects.0");
  CHECK(column.state.selected == ObjectPath{0});
}

TEST_CASE("what is selected elsewhere is unfolded and shown in the list") {
  TestColumn column;
  fill(column);
  column.state.selected = {1, 29};
  for (int k = 0; k < 3; ++k) column.draw();
  CHECK(column.has("objects.31"));
}

TEST_CASE("Ctrl + click adds to the selection and takes away again") {
  TestColumn column;
  fill(column);
  column.click("objects.0");
  ImGui::GetIO().KeyCtrl = true;
  column.click("objects.2");
  CHECK(all_selected(column.state) == std::vector<ObjectPath>{{2}, {0}});
  column.click("objects.0");
  ImGui::GetIO().KeyCtrl = false;
  CHECK(all_selected(column.state) == std::vector<ObjectPath>{{2}});
}

TEST_CASE("the wheel scrolls the list under the mouse; at its end, and where it was turned before, the column") {
  TestColumn column;
  fill(column);
  column.click("objects.1", 0.03);  // more lines than the list is high
  column.height = 900;
  for (int k = 0; k < 3; ++k) column.draw();
  const auto roll = [&](float notches) {
    ImGui::GetIO().MouseWheel = notches;
    column.draw();
    column.draw();
  };
  const auto pause = [&] {
    for (int k = 0; k < 40; ++k) column.draw();
  };
  compat::mouse_pos(ImGui::GetIO(), 200, 100);
  column.draw();
  for (int k = 0; k < 40; ++k) roll(-1);  // to the end of the column
  REQUIRE(column.has("objects.1"));
  const Rect before = column.rect("objects.1");
  column.aim("objects.1");
  roll(1);  // a moment ago the column was scrolled, so it still is
  CHECK(column.rect("objects.1").y0 > before.y0);
  roll(-1);
  pause();
  column.aim("objects.1");
  roll(-1);  // now it is the list
  CHECK_FALSE(column.has("objects.1"));
  roll(1);  // back to the list's start
  REQUIRE(column.has("objects.1"));
  CHECK(column.rect("objects.1") == before);
  roll(1);  // and on with the column
  CHECK(column.rect("objects.1").y0 > before.y0);
}

}  // namespace tyndall::test::objects_panel_test
