#include "app/window/menus/menu.h"
#include "tests/app/window/null_imgui.h"

#include <doctest/doctest.h>

namespace tyndall::test::palette_test {

namespace {

const std::vector<PaletteItem> items{{"save the scene", "Ctrl + S", "", {"save the scene"}},
                                     {"save as", "", "", {"save as"}},
                                     {"add a lamp", "", "", {"add a lamp"}},
                                     {"undo", "Ctrl + Z", "", {"undo"}}};

constexpr int key_down = 264, key_enter = 257;

/// The palette or a menu over a picture.
template <class List>
struct Drawn {
  NullImGui imgui;
  Ui ui;
  List list;
  std::optional<Request> chosen;

  void draw(int times = 1) {
    for (int k = 0; k < times; ++k)
      imgui.frame([&] {
        if (const auto now = list.draw(ui, {0, 0, 900, 700})) chosen = now;
      });
  }
  void click(float x, float y) {
    compat::mouse_pos(ImGui::GetIO(), x, y);
    draw();
    for (const bool down : {true, false}) {
      compat::mouse_button(ImGui::GetIO(), 0, down);
      draw();
    }
    draw(3);
  }
  void press(ImGuiKey key, int times = 1) {
    for (int k = 0; k < 2 * times; ++k) {
      compat::key(ImGui::GetIO(), key, k % 2 == 0);
      draw();
    }
  }
};

struct DrawnPalette : Drawn<Palette> {
  DrawnPalette() { open(); }
  void open() {
    list.open(items);
    draw(3);
  }
  void type(const char* text) {
    write(text);
    draw();
  }
  void enter() { press(ImGuiKey_Enter); }
};

}  // namespace

TEST_CASE("items are found by all words, in any order and case, other words too; those that begin so come first") {
  CHECK(matching_items(items, "") == std::vector<int>{0, 1, 2, 3});
  CHECK(matching_items(items, "SAVE") == std::vector<int>{0, 1});
  CHECK(matching_items(items, "scene save") == std::vector<int>{0});
  CHECK(matching_items(items, "a") == std::vector<int>{2, 0, 1});
  CHECK(matching_items(items, "nothing").empty());
  const std::vector<PaletteItem> others{
      {"larger text", "", "font size, preferences"}, {"full screen", "", ""}, {"size of the film", "", ""}};
  CHECK(matching_items(others, "font") == std::vector<int>{0});
  CHECK(matching_items(others, "larger font") == std::vector<int>{0});
  CHECK(matching_items(others, "size") == std::vector<int>{2, 0});
  CHECK(matching_items({{"clean view on or off", "", "denoise"}, {"view: noise", "", ""}}, "view noise") ==
        std::vector<int>{1, 0});
}

TEST_CASE("typing and the arrow keys mark an item, which Enter chooses") {
  DrawnPalette drawn;
  drawn.type("save");
  CHECK(drawn.list.take_key(key_down));
  drawn.draw();
  drawn.enter();
  CHECK(drawn.chosen == Request{"save as"});
}

TEST_CASE("after Return without a match, or a click into the palette, typing goes on where it was") {
  DrawnPalette drawn;
  drawn.type("sabe");
  drawn.enter();
  CHECK_FALSE(drawn.chosen);
  drawn.draw(3);
  drawn.press(ImGuiKey_Backspace, 2);
  drawn.type("thing");
  drawn.click(450, 300);
  REQUIRE(drawn.list.is_open());
  drawn.press(ImGuiKey_Backspace, 5);
  drawn.type("ve");
  drawn.enter();
  CHECK(drawn.chosen == Request{"save the scene"});
  CHECK_FALSE(drawn.list.is_open());
}

TEST_CASE("a click beside the palette closes it") {
  DrawnPalette drawn;
  drawn.click(5, 690);
  CHECK_FALSE(drawn.list.is_open());
  CHECK_FALSE(drawn.chosen);
  CHECK_FALSE(drawn.list.take_key(key_down));
}

TEST_CASE("what cannot be done in a menu is passed over by keys, and does nothing when it is clicked") {
  Drawn<Menu> menu;
  menu.list.open(100, 100, "ball", {{"no", "", "it cannot"}});
  menu.draw();
  for (float y = 100; y < 200; y += 3) menu.click(130, y);
  CHECK_FALSE(menu.chosen);
  menu.list.open(100, 100, "ball", {{"no", "", "it cannot"}, {"undo", "", ""}});
  CHECK(menu.list.take_key(key_down));
  CHECK(menu.list.take_key(key_enter));
  menu.draw();
  CHECK(menu.chosen == Request{"undo"});
}

TEST_CASE("what was typed into a palette that was closed cannot be undone in a later one") {
  DrawnPalette drawn;
  drawn.type("save");
  drawn.list.close();
  drawn.draw();
  drawn.open();
  compat::modifiers(ImGui::GetIO(), true, false, false, false);
  drawn.press(ImGuiKey_Z);
  drawn.press(ImGuiKey_Y);
  compat::modifiers(ImGui::GetIO(), false, false, false, false);
  drawn.type("u");
  drawn.enter();
  CHECK(drawn.chosen == Request{"undo"});
}

}  // namespace tyndall::test::palette_test
