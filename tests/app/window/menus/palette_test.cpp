#include "app/window/menus/menu.h"

#include "tests/app/window/panels/null_imgui.h"

#include <doctest/doctest.h>

namespace tyndall::test::palette_test {

namespace {

const std::vector<PaletteItem> items{{"save the scene", "Ctrl + S", "", {"save the scene"}},
                                     {"save as", "", "", {"save as"}},
                                     {"add a lamp", "", "", {"add a lamp"}},
                                     {"undo", "Ctrl + Z", "", {"undo"}}};

/// The palette over a picture.
struct Drawn {
  NullImGui imgui;
  Ui ui;
  Palette palette;
  std::optional<Request> chosen;

  Drawn() {
    palette.open(items);
    for (int k = 0; k < 3; ++k) draw();
  }
  void draw() {
    imgui.frame([&] {
      if (const auto now = palette.draw(ui, {0, 0, 900, 700})) chosen = now;
    });
  }
  void type(const char* text) {
    for (const char* c = text; *c; ++c) ImGui::GetIO().AddInputCharacter(static_cast<unsigned char>(*c));
    draw();
  }
  void press(ImGuiKey key) {
    compat::key(ImGui::GetIO(), key, true);
    draw();
    compat::key(ImGui::GetIO(), key, false);
    draw();
  }
  void enter() { press(ImGuiKey_Enter); }
};

}  // namespace

TEST_CASE("items are found by all words, in any order and case; those that begin so come first") {
  CHECK(matching_items(items, "") == std::vector<int>{0, 1, 2, 3});
  CHECK(matching_items(items, "SAVE") == std::vector<int>{0, 1});
  CHECK(matching_items(items, "scene save") == std::vector<int>{0});
  CHECK(matching_items(items, "a") == std::vector<int>{2, 0, 1});
  CHECK(matching_items(items, "nothing").empty());
}

TEST_CASE("actions are found by other words, too; the words of the name come before them") {
  const std::vector<PaletteItem> with_others{
      {"larger text", "", "font size, preferences"}, {"full screen", "", ""}, {"size of the film", "", ""}};
  CHECK(matching_items(with_others, "font") == std::vector<int>{0});
  CHECK(matching_items(with_others, "larger font") == std::vector<int>{0});
  CHECK(matching_items(with_others, "size") == std::vector<int>{2, 0});
  const std::vector<PaletteItem> views{{"clean view on or off", "", "denoise"}, {"view: noise", "", ""}};
  CHECK(matching_items(views, "view noise") == std::vector<int>{1, 0});
}

TEST_CASE("typing and Enter choose the first that fits, the arrow keys another one") {
  Drawn first;
  first.type("save");
  first.enter();
  CHECK(first.chosen == Request{"save the scene"});
  CHECK_FALSE(first.palette.is_open());
  Drawn second;
  second.type("save");
  CHECK(second.palette.take_key(264));  // down
  second.draw();
  second.enter();
  CHECK(second.chosen == Request{"save as"});
  Drawn none;
  none.type("nothing");
  none.enter();
  CHECK_FALSE(none.chosen);
  CHECK(none.palette.is_open());
}

TEST_CASE("after Return without a match, or a click into the palette, typing goes on where it was") {
  Drawn drawn;
  drawn.type("sabe");
  drawn.enter();
  for (int k = 0; k < 3; ++k) drawn.draw();
  drawn.press(ImGuiKey_Backspace);
  drawn.press(ImGuiKey_Backspace);
  drawn.type("ve a");
  drawn.enter();
  CHECK(drawn.chosen == Request{"save as"});
  Drawn clicked;
  clicked.type("nothing");
  compat::mouse_pos(ImGui::GetIO(), 450, 300);
  clicked.draw();
  for (const bool down : {true, false}) {
    compat::mouse_button(ImGui::GetIO(), 0, down);
    clicked.draw();
  }
  for (int k = 0; k < 3; ++k) clicked.draw();
  REQUIRE(clicked.palette.is_open());
  for (int k = 0; k < 7; ++k) clicked.press(ImGuiKey_Backspace);
  clicked.type("undo");
  clicked.enter();
  CHECK(clicked.chosen == Request{"undo"});
}

TEST_CASE("a click beside the palette closes it") {
  Drawn drawn;
  compat::mouse_pos(ImGui::GetIO(), 5, 690);
  drawn.draw();
  compat::mouse_button(ImGui::GetIO(), 0, true);
  drawn.draw();
  CHECK_FALSE(drawn.palette.is_open());
  CHECK_FALSE(drawn.chosen);
  CHECK_FALSE(drawn.palette.take_key(264));
}

TEST_CASE("what cannot be done in a menu is passed over by keys, and does nothing when it is clicked") {
  NullImGui imgui;
  Ui ui;
  Menu menu;
  std::optional<Request> chosen;
  const auto draw = [&] {
    imgui.frame([&] {
      if (const auto now = menu.draw(ui, {0, 0, 900, 700})) chosen = now;
    });
  };
  menu.open(100, 100, "ball", {{"no", "", "it cannot"}});
  draw();
  for (float y = 100; y < 200; y += 3) {
    compat::mouse_pos(ImGui::GetIO(), 130, y);
    for (const bool down : {true, false}) {
      compat::mouse_button(ImGui::GetIO(), 0, down);
      draw();
    }
  }
  CHECK_FALSE(chosen);
  menu.open(100, 100, "ball", {{"no", "", "it cannot"}, {"undo", "", ""}});
  CHECK(menu.take_key(264));  // down
  CHECK(menu.take_key(257));  // Enter
  draw();
  CHECK(chosen == Request{"undo"});
}

TEST_CASE("what was typed into a palette that was closed cannot be undone in a later one") {
  Drawn drawn;
  drawn.type("save");
  drawn.palette.close();
  drawn.draw();
  drawn.palette.open(items);
  for (int k = 0; k < 3; ++k) drawn.draw();
  compat::modifiers(ImGui::GetIO(), true, false, false, false);
  drawn.press(ImGuiKey_Z);
  drawn.press(ImGuiKey_Y);
  compat::modifiers(ImGui::GetIO(), false, false, false, false);
  drawn.type("u");
  drawn.enter();
  CHECK(drawn.chosen == Request{"undo"});
}

}  // namespace tyndall::test::palette_test
