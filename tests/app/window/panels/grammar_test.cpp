#include "app/window/edit/arrange.h"
#include "core/scene/check.h"
#include "tests/app/window/panels/column.h"

#include <cmath>

namespace tyndall::test::grammar_test {

namespace {

const Solid3d& solid(const TestColumn& column, std::size_t k) {
  return std::get<Solid3d>(column.scene().objects[k].kind);
}

}  // namespace

TEST_CASE("a double click sets sliders and numbers back to what the file has") {
  TestColumn column;
  column.gold().fuzz = 0.7;
  column.click_twice("gold.fuzz", 0.1);
  CHECK(column.gold().fuzz == 0.18);
  column.gold().fuzz = 0.7;
  column.click_twice("gold.fuzz.value");
  CHECK(column.gold().fuzz == 0.18);
  CHECK(column.ui.edit.id == 0);
  column.scene().camera.look_from = {3, 4, 5};
  column.click_twice("camera.look_from.y");
  CHECK(column.scene().camera.look_from == Vec3d{3, 1, 5});
  column.scene().materials[0].colour = Vec3d{0, 0, 0};
  column.click_twice("gold.albedo.g");
  CHECK(std::get<Vec3d>(column.scene().materials[0].colour) == Vec3d{0, 0.6, 0});
}

TEST_CASE("what the file does not have goes back to its default") {
  TestColumn column;
  column.saved.materials.clear();
  column.gold().fuzz = 0.7;
  column.click_twice("gold.fuzz.value");
  CHECK(column.gold().fuzz == Metal<>{}.fuzz);
}

TEST_CASE("Shift drags a tenth as far, on sliders and on numbers") {
  for (const char* name : {"gold.fuzz", "gold.fuzz.value"}) {
    double direction[2];
    for (const bool shift : {false, true}) {
      TestColumn column;
      column.gold().fuzz = 0.5;
      column.draw();
      column.aim(name, 0.5);
      column.button(true);
      const double before = column.gold().fuzz;
      ImGui::GetIO().KeyShift = shift;
      column.aim(name, 0.9);
      direction[shift ? 1 : 0] = column.gold().fuzz - before;
      column.button(false);
    }
    CHECK(direction[0] > 0.03);
    CHECK(direction[1] == doctest::Approx(direction[0] / 10).epsilon(0.1).scale(0));
  }
}

TEST_CASE("Ctrl snaps to round numbers, on sliders and on numbers") {
  TestColumn column;
  column.aim("gold.fuzz", 0.3);
  column.button(true);
  ImGui::GetIO().KeyCtrl = true;
  column.aim("gold.fuzz", 0.37);
  CHECK(column.gold().fuzz * 20 == std::round(column.gold().fuzz * 20));
  column.button(false);
  column.aim("camera.vfov.value", 0.5);
  column.button(true);
  column.aim("camera.vfov.value", 1.3);
  CHECK(column.scene().camera.vfov == std::round(column.scene().camera.vfov));
  column.button(false);
  ImGui::GetIO().KeyCtrl = false;
}

TEST_CASE("sums can be typed") {
  TestColumn column;
  column.type("gold.fuzz.value", "1/4");
  CHECK(column.gold().fuzz == 0.25);
  column.type("gold.fuzz.value", "2*pi");
  CHECK(column.problem == "fuzz: found 2*pi, expected a number in [0, 1]");
}

TEST_CASE("the type of a material is chosen from a list, and fog within makes a companion") {
  TestColumn column;
  column.state.selected = {0};
  column.draw();
  column.click("Ball.type");
  column.click("Ball.type.lambertian");
  CHECK(std::holds_alternative<Lambertian<>>(column.scene().materials[0].kind));
  column.click("Ball.type");
  column.click("Ball.type.fog within");
  CHECK(linked_objects(column.scene(), {0}) == std::vector<ObjectPath>{{1}});
  CHECK_FALSE(check(column.scene()));
  column.state.selected = {2};  // the bubble
  column.draw();
  column.click("Bubble.type");
  column.click("Bubble.type.fog within");
  CHECK(column.scene().objects.size() == 4);  // a negative radius has no inside
}

TEST_CASE("Esc closes a list, and nothing is chosen") {
  TestColumn column;
  column.state.selected = {0};
  column.draw();
  column.click("Ball.type");
  CHECK(popup_is_open());
  column.ui.close_popup = true;
  column.draw();
  column.ui.close_popup = false;
  column.draw();
  CHECK_FALSE(popup_is_open());
  column.click("gold.albedo.swatch");
  CHECK(popup_is_open());
  column.ui.close_popup = true;
  column.draw();
  column.ui.close_popup = false;
  column.draw();
  CHECK_FALSE(popup_is_open());
}

TEST_CASE("a shared material can be made a single user's") {
  TestColumn column;
  column.state.selected = {0};
  column.draw();
  CHECK_FALSE(column.has("Ball.single_user"));
  std::get<Solid3d>(column.scene().objects[1].kind).material = 0;
  column.draw();
  column.click("Ball.single_user");
  CHECK(column.scene().materials[static_cast<std::size_t>(solid(column, 0).material)].name == "gold 2");
  CHECK(solid(column, 1).material == 0);
}

TEST_CASE("a lamp has a colour and a power: the power keeps the colour, and stops double it") {
  TestColumn column;
  column.scene().materials[0] = {"lamp", Vec3d{4, 2, 1}, Light<>{}};
  column.state.selected = {0};
  column.draw();
  const auto radiance = [&] { return std::get<Vec3d>(column.scene().materials[0].colour); };
  column.type("lamp.power.value", "10");
  CHECK(radiance() == Vec3d{10, 5, 2.5});
  column.click("lamp.stops.+ 1");
  CHECK(radiance() == Vec3d{20, 10, 5});
  column.click("lamp.stops.- 1");
  column.type("lamp.color.g", "1");
  CHECK(radiance() == Vec3d{10, 10, 2.5});
}

TEST_CASE("a background keeps its colours when its kind changes, and has its own ones again when it changes back") {
  TestColumn column;
  column.scene().background = Gradient{{0.1, 0.2, 0.3}, {0.4, 0.5, 0.6}};
  column.click("background.kind.hemispheres");
  CHECK(column.scene().background == Background(Hemispheres{{0.4, 0.5, 0.6}, {0.1, 0.2, 0.3}}));
  column.click("background.kind.colour");
  column.click("background.kind.gradient");
  CHECK(column.scene().background == Background(Gradient{{0.1, 0.2, 0.3}, {0.4, 0.5, 0.6}}));
  column.click("background.kind.image");  // there has been no picture yet
  CHECK(std::holds_alternative<Gradient>(column.scene().background));
}

TEST_CASE("a name is typed where it is shown, or by the key for it; Esc leaves it") {
  TestColumn column;
  column.state.selected = {0};
  column.draw();
  column.type("Ball.name", "marble");
  CHECK(column.scene().objects[0].name == "marble");
  column.state.rename = true;
  column.draw();
  CHECK_FALSE(column.state.rename);
  column.draw();
  ImGui::GetIO().AddInputCharacter('x');
  column.draw();
  column.press(ImGuiKey_Escape);
  CHECK(column.scene().objects[0].name == "marble");
  CHECK(column.ui.edit.id == 0);
}

TEST_CASE("Esc takes a drag back, of sliders and of numbers, and the mouse changes nothing until it is let go") {
  for (const char* name : {"gold.fuzz", "gold.fuzz.value"}) {
    TestColumn column;
    column.gold().fuzz = 0.5;
    column.draw();
    column.aim(name, 0.5);
    column.button(true);
    CHECK(column.ui.drag.active);
    column.aim(name, 0.9);
    CHECK(column.gold().fuzz != 0.5);
    column.ui.drag.cancel = true;
    column.draw();
    CHECK(column.gold().fuzz == 0.5);
    column.aim(name, 0.1);
    CHECK(column.gold().fuzz == 0.5);
    CHECK_FALSE(column.ui.drag.active);
    column.button(false);
    column.draw();
    CHECK(column.gold().fuzz == 0.5);
    CHECK(column.ui.edit.id == 0);
  }
}

}  // namespace tyndall::test::grammar_test
