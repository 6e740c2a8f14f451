#include "app/window/panels/panels.h"

#include "app/window/accuracy/views.h"
#include "core/scene/check.h"
#include "tests/app/window/panels/column.h"

#include <doctest/doctest.h>

namespace tyndall::test::panels_test {

TEST_CASE("a new user finds fuzz, refractive index and density at once") {
  const TestColumn column;
  for (const char* name : {"gold.fuzz", "glass.refractive_index", "Fog.density", "Fog.g", "Ball.radius", "camera.vfov",
                           "image.exposure", "render.max_depth", "chart", "scenes.cover"})
    CHECK_MESSAGE(column.has(name), name);
}

TEST_CASE("drawing changes nothing, nor does a click into a number that has more digits than it shows") {
  TestColumn column;
  const Scene before = column.scene();
  for (int k = 0; k < 5; ++k) column.draw();
  CHECK(column.scene() == before);
  column.click("glass.refractive_index.value");
  column.draw();
  column.press(ImGuiKey_Enter);
  CHECK(column.scene() == before);
}

TEST_CASE("a slider follows the mouse, from end to end") {
  TestColumn column;
  column.aim("gold.fuzz", 0.01);
  column.button(true);
  column.aim("gold.fuzz", 0.5);
  CHECK(column.gold().fuzz == doctest::Approx(0.5).epsilon(0.02).scale(0));
  column.aim("gold.fuzz", 3);
  CHECK(column.gold().fuzz == 1);
  column.aim("gold.fuzz", -2);
  CHECK(column.gold().fuzz == 0);
  column.button(false);
  column.aim("gold.fuzz", 0.9);
  CHECK(column.gold().fuzz == 0);
  CHECK_FALSE(check(column.scene()));
}

TEST_CASE("a press on the grab moves nothing, though the value has more digits than a slider gives") {
  TestColumn column;
  const Rect rect = column.rect("glass.refractive_index");
  const double width = static_cast<double>(rect.width()), grab = 14, margin = 2;
  const double middle = margin + grab / 2 + (2.0 / 3 - 0.5) / 2.5 * (width - 2 * margin - grab);
  column.aim("glass.refractive_index", (middle + 3) / width);
  column.button(true);
  column.draw();
  CHECK(column.glass().refractive_index == 2.0 / 3);
  column.aim("glass.refractive_index", (middle + 13) / width);
  CHECK(column.glass().refractive_index > 0.7);
  column.button(false);
}

TEST_CASE("typed values: taken where valid, refused with a reason elsewhere") {
  TestColumn column;
  column.type("gold.fuzz.value", "0.25");
  CHECK(column.gold().fuzz == 0.25);
  CHECK(column.problem.empty());
  column.type("gold.fuzz.value", "1.5");
  CHECK(column.gold().fuzz == 0.25);
  CHECK(column.problem == "fuzz: found 1.5, expected a number in [0, 1]");
  column.type("gold.fuzz.value", "much");
  CHECK(column.gold().fuzz == 0.25);
  CHECK(column.problem == "fuzz: found much, expected a number in [0, 1]");
  column.type("glass.refractive_index.value", "7.5");  // beyond the slider, but valid
  CHECK(column.glass().refractive_index == 7.5);
}

TEST_CASE("escape leaves a value as it was") {
  TestColumn column;
  column.click("gold.fuzz.value");
  column.draw();
  ImGui::GetIO().AddInputCharacter('1');
  column.draw();
  column.press(ImGuiKey_Escape);
  CHECK(column.gold().fuzz == 0.18);
  CHECK(column.ui.edit.id == 0);
}

TEST_CASE("tab goes on to the next number") {
  TestColumn column;
  column.click("gold.fuzz.value");
  column.draw();
  for (const char c : {'0', '.', '5'}) ImGui::GetIO().AddInputCharacter(static_cast<unsigned>(c));
  column.draw();
  column.press(ImGuiKey_Tab);
  CHECK(column.gold().fuzz == 0.5);
  column.draw();
  ImGui::GetIO().AddInputCharacter('0');
  column.draw();
  column.press(ImGuiKey_Enter);
  CHECK(std::get<Vec3d>(column.scene().materials[0].colour).x == 0);
}

TEST_CASE("numbers are dragged sideways") {
  TestColumn column;
  column.aim("camera.look_from.x", 0.5);
  column.button(true);
  column.aim("camera.look_from.x", 1.5);
  column.button(false);
  CHECK(column.scene().camera.look_from.x > 0.5);
  CHECK(column.scene().camera.look_from.y == 1);
  column.draw();
  CHECK(column.ui.edit.id == 0);  // a drag is no click
}

TEST_CASE("choices change what they say, and only that") {
  TestColumn column;
  column.click("render.fresnel.schlick");
  CHECK(column.scene().render.fresnel == FresnelKind::schlick);
  column.click("image.tone_map.aces");
  CHECK(column.scene().display.tone_map == ToneMap::aces);
  column.click("image.view.normal");
  CHECK(column.state.now.view == 2);
  column.click("image.view.cost");
  CHECK(column.state.now.view == view_named("cost"));
  column.click("image.view.FLIP");
  CHECK(column.state.now.view == view_named("cost"));
  CHECK(column.problem == "FLIP: needs a reference: see Speed and accuracy");
  column.click("scenes.cover");
  CHECK(column.has_query_for({"scene", "cover"}));
}

TEST_CASE("a drawing in which no control was moved leaves the scene alone, and one in which one was says so") {
  TestColumn column;
  column.draw();
  CHECK_FALSE(column.changed);
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

TEST_CASE("the controls of the section Accuracy ask for what they say") {
  TestColumn column;
  column.click("chart.export");
  column.click("chart.reference");
  CHECK(column.has_query_for({"export the chart"}));
  CHECK(column.has_query_for({"reference picture"}));
  column.requested.clear();
  column.click("render.split.on");
  CHECK(column.requested == std::vector<Request>{{"split view"}});
  column.state.now.split = true, column.state.now.kept_method = "path";
  column.click("render.split.on");  // it is on
  CHECK(column.requested.size() == 1);
  column.click("render.split.off");
  CHECK(column.requested.size() == 2);
  column.click("image.clean.beside raw");
  CHECK(column.requested.back() == Request{"clean", "beside raw"});
  column.click("render.at.window");
  CHECK(column.requested.back() == Request{"render at", "window"});
}

TEST_CASE("errors are seen only where there is something to measure against") {
  TestColumn column;
  column.click("image.view.error");
  CHECK(column.state.now.view == 0);
  CHECK(column.problem == "error: needs a reference: see Speed and accuracy");
  column.state.now.can_show_errors = true;
  column.click("image.view.FLIP");
  CHECK(column.state.now.view == view_named("FLIP"));
  column.click("image.view.error");
  CHECK(column.state.now.view == view_named("error"));
}

TEST_CASE("a click in the list of objects selects one and shows its values, a second click on it selects nothing") {
  TestColumn column;
  column.click("objects.1");
  CHECK(column.state.selected == ObjectPath{1});
  column.draw();
  for (const char* name : {"glass.refractive_index", "Bubble.center.x", "Bubble.radius", "Bubble.transform0"})
    CHECK_MESSAGE(column.has(name), name);
  CHECK_FALSE(column.has("gold.fuzz"));
  CHECK_FALSE(column.has("Bubble.center_end.x"));
  column.type("Bubble.radius.value", "0");
  CHECK(column.problem == "radius: found 0, expected a number other than 0");
  column.click("objects.1");
  CHECK(column.state.selected.empty());
}

TEST_CASE("a negative radius stays negative on its slider") {
  TestColumn column;
  column.state.selected = {1};
  column.draw();
  column.draw();
  column.click("Bubble.radius", 0.9);
  const double radius = std::get<Sphere<>>(std::get<Solid3d>(column.scene().objects[1].kind).shape).radius;
  CHECK(radius < -1);
}

TEST_CASE("a click on a section's heading folds it and unfolds it again") {
  TestColumn column;
  column.click("section.Camera");
  column.draw();
  CHECK_FALSE(column.has("camera.vfov"));
  column.click("section.Camera");
  column.draw();
  CHECK(column.has("camera.vfov"));
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

TEST_CASE("the menu of a row has each line once, also where the row has three numbers") {
  TestColumn column;
  const auto first_line = [&](const std::string& aim, const std::string& line) {
    column.aim(aim);
    const float mouse = ImGui::GetIO().MousePos.y;
    column.button(true, 1);
    column.button(false, 1);
    column.draw();
    column.draw();
    REQUIRE_MESSAGE(column.has(line), line);
    const float y = column.rect(line).y0 - mouse;
    column.press(ImGuiKey_Escape);
    return y;
  };
  const float slider = first_line("gold.fuzz", "gold.fuzz.vary");
  CHECK(first_line("camera.look_from.y", "camera.look_from.key") == doctest::Approx(slider).epsilon(0.1));
}

}  // namespace tyndall::test::panels_test
