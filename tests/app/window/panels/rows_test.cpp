#include "core/scene/check.h"
#include "tests/app/window/panels/column.h"

#include <cmath>

namespace tyndall::test::rows_test {

TEST_CASE("drawing changes nothing, nor does a click into a number; a drawing in which a control was moved says so") {
  TestColumn column;
  const Scene before = column.scene();
  column.draw(5);
  CHECK(column.scene() == before);
  column.click("glass.refractive_index.value");
  column.press(ImGuiKey_Enter);
  CHECK(column.scene() == before);
  column.draw();
  column.aim("gold.fuzz", 0.7);
  CHECK_FALSE(column.changed);
  column.button(true);
  CHECK(column.changed);
  column.draw();  // the mouse is held still
  CHECK_FALSE(column.changed);
  column.button(false);
  for (const char* control : {"render.fresnel.schlick", "image.tone_map.aces", "background.kind.gradient"}) {
    column.aim(control);
    column.button(true);
    column.button(false);
    CHECK_MESSAGE(column.changed, control);
    column.draw();
    CHECK_FALSE(column.changed);
  }
}

TEST_CASE("a slider follows the mouse, from end to end; a negative radius stays negative") {
  TestColumn column;
  column.drag("gold.fuzz", 0.01, 0.5);
  CHECK(column.fuzz() == about(0.5, 0.02));
  column.aim("gold.fuzz", 3);
  CHECK(column.fuzz() == 1);
  column.aim("gold.fuzz", -2);
  CHECK(column.fuzz() == 0);
  column.button(false);
  column.aim("gold.fuzz", 0.9);
  CHECK(column.fuzz() == 0);
  CHECK_FALSE(check(column.scene()));
  column.select({1});
  column.click("Bubble.radius", 0.9);
  CHECK(shape(column.scene(), 1).radius < -1);
}

TEST_CASE("a press on the grab moves nothing, though the value has more digits than a slider gives") {
  TestColumn column;
  const double width = static_cast<double>(column.rect("glass.refractive_index").width()), grab = 14, margin = 2;
  const double middle = margin + grab / 2 + (2.0 / 3 - 0.5) / 2.5 * (width - 2 * margin - grab);
  column.drag("glass.refractive_index", (middle + 3) / width, (middle + 3) / width);
  CHECK(column.refractive_index() == 2.0 / 3);
  column.aim("glass.refractive_index", (middle + 13) / width);
  CHECK(column.refractive_index() > 0.7);
}

TEST_CASE("numbers and sums are typed: taken where valid, also beyond the slider, else refused with a reason") {
  TestColumn column;
  struct Typed {
    const char *row, *text;
    double value;
    const char* problem;
  };
  column.select({0});
  for (const auto& [row, text, value, problem] :
       {Typed{"gold.fuzz.value", "0.25", 0.25, ""},
        {"gold.fuzz.value", "1/5", 0.2, ""},
        {"gold.fuzz.value", "1.5", 0.2, "fuzz: found 1.5, expected a number in [0, 1]"},
        {"gold.fuzz.value", "much", 0.2, "fuzz: found much, expected a number in [0, 1]"},
        {"gold.fuzz.value", "2*pi", 0.2, "fuzz: found 2*pi, expected a number in [0, 1]"},
        {"Ball.radius.value", "0", 0.7, "radius: found 0, expected a number other than 0"}}) {
    column.problem.clear();
    column.type(row, text);
    CHECK(column.problem == problem);
    CHECK((row[0] == 'g' ? column.fuzz() : shape(column.scene()).radius) == value);
  }
  column.select({1});
  column.type("glass.refractive_index.value", "7.5");
  CHECK(column.refractive_index() == 7.5);
}

TEST_CASE("Esc leaves a value as it was, Tab goes on to the next number") {
  TestColumn column;
  column.click("gold.fuzz.value");
  column.write("1");
  column.press(ImGuiKey_Escape);
  CHECK(column.fuzz() == 0.18);
  CHECK_FALSE(column.has_keyboard());
  column.click("gold.fuzz.value");
  column.write("0.5");
  column.press(ImGuiKey_Tab);
  CHECK(column.fuzz() == 0.5);
  column.write("0");
  column.press(ImGuiKey_Enter);
  CHECK(column.colour().x == 0);
}

TEST_CASE("numbers are dragged sideways") {
  TestColumn column;
  column.drag("camera.look_from.x", 0.5, 1.5);
  column.button(false);
  CHECK(column.scene().camera.look_from.x > 0.5);
  CHECK(column.scene().camera.look_from.y == 1);
  column.draw();
  CHECK_FALSE(column.has_keyboard());  // a drag is no click
}

TEST_CASE("a double click sets sliders and numbers back to what the file has, or else to the default") {
  TestColumn column;
  for (const auto& [name, across] : {std::pair{"gold.fuzz", 0.1}, {"gold.fuzz.value", 0.5}}) {
    column.fuzz() = 0.7;
    column.click_twice(name, across);
    CHECK(column.fuzz() == 0.18);
    CHECK_FALSE(column.has_keyboard());
  }
  column.scene().camera.look_from = {3, 4, 5};
  column.click_twice("camera.look_from.y");
  CHECK(column.scene().camera.look_from == Vec3d{3, 1, 5});
  column.scene().materials[0].colour = Vec3d{0, 0, 0};
  column.click_twice("gold.albedo.g");
  CHECK(column.colour() == Vec3d{0, 0.6, 0});
  column.saved.materials.clear();
  column.fuzz() = 0.7;
  column.click_twice("gold.fuzz.value");
  CHECK(column.fuzz() == Metal<>{}.fuzz);
}

TEST_CASE("on sliders and numbers Shift drags a tenth as far, Ctrl snaps, and Esc takes a drag back") {
  for (const char* name : {"gold.fuzz", "gold.fuzz.value"}) {
    double way[2];
    for (const bool shift : {false, true}) {
      TestColumn column;
      column.fuzz() = 0.5;
      column.draw();
      column.drag(name, 0.5, 0.5);
      const double before = column.fuzz();
      ImGui::GetIO().KeyShift = shift;
      column.aim(name, 0.9);
      way[shift ? 1 : 0] = column.fuzz() - before;
      CHECK(column.ui.drag.active);
      column.ui.drag.cancel = true;
      column.draw();
      CHECK(column.fuzz() == 0.5);
      column.aim(name, 0.1);
      CHECK(column.fuzz() == 0.5);
      CHECK_FALSE(column.ui.drag.active);
      column.button(false);
      column.draw();
      CHECK(column.fuzz() == 0.5);
      CHECK_FALSE(column.has_keyboard());
    }
    CHECK(way[0] > 0.03);
    CHECK(way[1] == about(way[0] / 10, 0.1));
  }
  TestColumn column;
  column.drag("gold.fuzz", 0.3, 0.3);
  ImGui::GetIO().KeyCtrl = true;
  column.aim("gold.fuzz", 0.37);
  CHECK(column.fuzz() * 20 == std::round(column.fuzz() * 20));
  column.button(false);
  column.drag("camera.vfov.value", 0.5, 1.3);
  CHECK(column.scene().camera.vfov == std::round(column.scene().camera.vfov));
}

TEST_CASE("choices change what they say, and only that; errors are seen only where there is a reference") {
  TestColumn column;
  column.click("render.fresnel.schlick");
  CHECK(column.scene().render.fresnel == FresnelKind::schlick);
  column.click("image.tone_map.aces");
  CHECK(column.scene().display.tone_map == ToneMap::aces);
  const auto shows = [&](const std::string& clicked) {
    column.click("image.view." + clicked);
    return std::string(view_entry(column.state.now.view).name);
  };
  for (const char* view : {"normal", "cost"}) CHECK(shows(view) == view);
  for (const std::string view : {"FLIP", "error"}) {
    CHECK(shows(view) == "cost");
    CHECK(column.problem == view + ": needs a reference: see Speed and accuracy");
  }
  column.state.now.can_show_errors = true;
  for (const char* view : {"FLIP", "error"}) CHECK(shows(view) == view);
}

TEST_CASE("a lamp has a colour and a power: the power keeps the colour, and stops double it") {
  TestColumn column;
  column.scene().materials[0] = {"lamp", Vec3d{4, 2, 1}, Light<>{}};
  column.select({0});
  column.type("lamp.power.value", "10");
  CHECK(column.colour() == Vec3d{10, 5, 2.5});
  column.click("lamp.stops.+ 1");
  CHECK(column.colour() == Vec3d{20, 10, 5});
  column.click("lamp.stops.- 1");
  column.type("lamp.color.g", "1");
  CHECK(column.colour() == Vec3d{10, 10, 2.5});
}

TEST_CASE("a background keeps its colours when its kind changes, and has its own ones again when it changes back") {
  TestColumn column;
  const Gradient gradient{{0.1, 0.2, 0.3}, {0.4, 0.5, 0.6}};
  column.scene().background = gradient;
  column.click("background.kind.hemispheres");
  CHECK(column.scene().background == Background(Hemispheres{gradient.top, gradient.bottom}));
  column.click("background.kind.colour");
  CHECK(column.scene().background == Background(gradient.top));
  column.click("background.kind.gradient");
  CHECK(column.scene().background == Background(gradient));
  column.click("background.kind.image");  // there has been no picture yet
  CHECK(column.scene().background == Background(gradient));
}

TEST_CASE("a shared material can be made a single user's") {
  TestColumn column;
  column.select({0});
  CHECK_FALSE(column.has("Ball.single_user"));
  const auto material = [&](std::size_t k) -> int& {
    return std::get<Solid3d>(column.scene().objects[k].kind).material;
  };
  material(1) = 0;
  column.draw();
  column.click("Ball.single_user");
  CHECK(column.scene().materials[static_cast<std::size_t>(material(0))].name == "gold 2");
  CHECK(material(1) == 0);
  CHECK(column.scene().materials[2].kind == column.scene().materials[0].kind);
  CHECK_FALSE(column.has("Ball.single_user"));
}

TEST_CASE("the menu of a row has each line once, also where the row has three numbers") {
  TestColumn column;
  const auto first_line = [&](const std::string& row, const std::string& line) {
    column.click(row, 0.5, 1, 1);
    const float mouse = ImGui::GetIO().MousePos.y;
    REQUIRE_MESSAGE(column.has(line), line);
    const float y = column.rect(line).y0 - mouse;
    column.press(ImGuiKey_Escape);
    return y;
  };
  const float slider = first_line("gold.fuzz", "gold.fuzz.vary");
  CHECK(first_line("camera.look_from.y", "camera.look_from.key") == doctest::Approx(slider).epsilon(0.1));
}

}  // namespace tyndall::test::rows_test
