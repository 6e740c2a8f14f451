#include "app/window/system/preferences.h"
#include "app/window/system/style.h"
#include "app/window/system/ui_log.h"
#include "tests/app/window/null_imgui.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

namespace tyndall::test::preferences_test {

TEST_CASE("preferences: what was written is read, the rest has its default, and what others wrote is kept") {
  const auto folder = scratch_folder("preferences_test"), file = folder / "of" / "tyndall" / "window.txt";
  CHECK(read_preferences(file) == Preferences{});
  CHECK(Preferences{}.clean);
  for (const Preferences& written :
       {Preferences{false, Theme::light, 1.25, 480, {"Camera", "Speed and accuracy"}}, {}}) {
    write_preferences(file, written);
    CHECK(read_preferences(file) == written);
  }
  write_text(file, "clean off\nbrush-size 3 4\ntheme light\n");
  auto read = read_preferences(file);
  REQUIRE(read);
  CHECK_FALSE(read->clean);
  CHECK(read->theme == Theme::light);
  CHECK(read->text_size == 1);
  read->clean = true;
  write_preferences(file, *read);
  CHECK(read_text(file).find("\nbrush-size 3 4\n") != std::string::npos);
  CHECK(read_preferences(file) == read);
}

TEST_CASE("preferences: of a damaged file nothing is taken, and it is set aside once") {
  const auto folder = scratch_folder("preferences_test");
  const auto file = folder / "window.txt";
  for (const char* text :
       {"clean perhaps\n", "clean off\nOther on\n", "no preferences\n", "clean off\ntext-size 40\n", "column -1\n",
        "column wide\n", "theme", "\x01\x02\n", "text-size nan\n", "folded a\nfolded a\n"}) {
    write_text(file, text);
    CHECK_MESSAGE(!read_preferences(file), text);
  }
  CHECK(set_aside(file) == folder / "window.txt.damaged");
  CHECK(read_preferences(file) == Preferences{});
  CHECK(set_aside(file).empty());
}

TEST_CASE("preferences: what cannot be written is forgotten without a word") {
  const auto folder = scratch_folder("preferences_test");
  write_text(folder / "file", "no folder");
  CHECK_NOTHROW(write_preferences(folder / "file" / "window.txt", {}));
  CHECK_NOTHROW(write_preferences({}, {}));
}

TEST_CASE("preferences: texts grow and shrink by steps, up to the ends") {
  Preferences preferences;
  for (const auto& [steps, size] : {std::pair{1, 1.1}, {-2, 0.9}, {9, 2.0}, {-9, 0.8}}) {
    step_text_size(preferences, steps);
    CHECK(preferences.text_size == size);
  }
}

TEST_CASE("what Latin, Greek and Cyrillic fonts do not have is asked for once, and loaded at any size") {
  Characters more;
  CHECK_FALSE(add_characters("Ball 3 – Kugel groß, сфера, σφαίρα", more));
  CHECK(add_characters("金の球", more));
  CHECK(more == Characters{0x91d1, 0x306e, 0x7403});
  CHECK_FALSE(add_characters("球", more));
  CHECK_FALSE(add_characters("\xff\xe9\x87 \xf0\x9f\x98\x80 \x80", more));
  CHECK(more.size() == 3);
  NullImGui imgui;
  for (const float size : {0.8f, 1.0f, 2.0f}) {
    const Fonts fonts = load_fonts(size, 1, {0x91d1, 0xac00});
    REQUIRE(fonts.body != nullptr);
    CHECK(fonts.body->FindGlyphNoFallback('A') != nullptr);
    CHECK(fonts.mono->FindGlyphNoFallback('0') != nullptr);
  }
}

TEST_CASE("the log says what changed, and at the end how long things took") {
  const auto file = scratch_folder("ui_log") / "ui.log";
  {
    UiLog log(file);
    for (int drawing = 0; drawing < 3; ++drawing) {
      log.widget("gold.fuzz", {1, 2, 3, 4}, drawing < 2 ? "0.1" : "0.2");
      if (drawing == 0) log.widget("a name", {0, 0, 1, 1}, "x");
      log.end_of_widgets();
    }
    log.submitted(1, 10, false);
    log.submitted(2, 10.5, true);
    const auto clean = std::make_shared<const CleanFrame>();
    Frame frame;
    frame.step = 8;
    frame.first_picture_ms = 15;
    struct Shown {
      std::uint64_t edit;
      bool is_clean;
      double at;
    };
    for (const auto& [edit, is_clean, at] : {Shown{1, false, 10.02},
                                             {1, false, 10.05},
                                             {1, true, 10.25},
                                             {1, true, 10.5},
                                             {2, false, 10.6},
                                             {2, true, 10.75}}) {
      frame.edit = edit;
      frame.clean = is_clean ? clean : nullptr;
      log.shown(frame, at);
      frame.step = 1, frame.spp = 1;
    }
    log.drawn(0.002, true);
    Mouse mouse;
    mouse.x = mouse.y = -3e38f;
    log.mouse(mouse);
    mouse.x = 12, mouse.y = 34, mouse.down[0] = true, mouse.typing = true;
    log.mouse(mouse);
    mouse.down[0] = false, mouse.wheel = -1;
    log.mouse(mouse);
    for (int k = 0; k < 2; ++k) log.rest();
    log.line("key 82");
    log.rest();
  }
  CHECK(read_text(file) ==
        "widget gold.fuzz 1 2 3 4 0.1\nwidget a_name 0 0 1 1 x\ngone a_name\nwidget gold.fuzz 1 2 3 4 0.2\n"
        "submit 1\nsubmit 2\nframe 1 0 8 20.0 15.0\nframe 1 1 1 50.0 15.0\nframe 1 1 1 250.0 15.0\n"
        "frame 1 1 1 500.0 15.0\nframe 2 1 1 100.0 15.0\nframe 2 1 1 250.0 15.0\ndrawn 2.00 1\n"
        "mouse none\nbuttons 0 0 0\nkeyboard shortcuts\nmouse 12 34\nbuttons 1 0 0\nkeyboard control\n"
        "buttons 0 0 0\nwheel -1\nrest\nkey 82\nrest\n"
        "latency n 2 p50 20.0 p95 100.0 p99 100.0 max 100.0 ms\n"
        "latency camera n 1 p50 100.0 p95 100.0 p99 100.0 max 100.0 ms\n"
        "latency other n 1 p50 20.0 p95 20.0 p99 20.0 max 20.0 ms\n"
        "latency clean n 1 p50 250.0 p95 250.0 p99 250.0 max 250.0 ms\n"
        "cpu picture n 1 p50 2.0 p95 2.0 p99 2.0 max 2.0 ms\ncpu plain n 0 p50 0.0 p95 0.0 p99 0.0 max 0.0 ms\n");
  CHECK_THROWS_AS(UiLog("/no/such/folder/log"), std::exception);
}

}  // namespace tyndall::test::preferences_test
