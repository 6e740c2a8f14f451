#include "app/window/system/preferences.h"
#include "tests/scene/files.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

#include <fstream>

namespace tyndall::test::preferences_test {

TEST_CASE("preferences: what was written is read; what is not said has its default") {
  const auto folder = scratch_folder("preferences_test");
  const auto file = folder / "of" / "tyndall" / "window.txt";
  CHECK(read_preferences(file) == Preferences{});
  CHECK(Preferences{}.clean);
  const Preferences other{false, Theme::light, 1.25, 480, {"Camera", "Speed and accuracy"}};
  write_preferences(file, other);
  CHECK(read_preferences(file) == other);
  write_preferences(file, {});
  CHECK(read_preferences(file) == Preferences{});
  std::ofstream(file) << "clean off\n";
  Preferences raw;
  raw.clean = false;
  CHECK(read_preferences(file) == raw);
}

TEST_CASE("preferences: what another version wrote is kept for it") {
  const auto file = scratch_folder("preferences_test") / "window.txt";
  std::ofstream(file) << "clean off\nbrush-size 3 4\ntheme light\n";
  auto read = read_preferences(file);
  REQUIRE(read);
  CHECK_FALSE(read->clean);
  CHECK(read->theme == Theme::light);
  read->clean = true;
  write_preferences(file, *read);
  CHECK(test::read_text(file).find("\nbrush-size 3 4\n") != std::string::npos);
  CHECK(read_preferences(file) == read);
}

TEST_CASE("preferences: of a damaged file nothing is taken, and it is set aside once") {
  const auto folder = scratch_folder("preferences_test");
  const auto file = folder / "window.txt";
  for (const char* text :
       {"clean perhaps\n", "clean off\nOther on\n", "no preferences\n", "clean off\ntext-size 40\n", "column -1\n",
        "column wide\n", "theme", "\x01\x02\n", "text-size nan\n", "folded a\nfolded a\n"}) {
    std::ofstream(file) << text;
    CHECK_MESSAGE(!read_preferences(file), text);
  }
  CHECK(set_aside(file) == folder / "window.txt.damaged");
  CHECK(read_preferences(file) == Preferences{});
  CHECK(set_aside(file).empty());
}

TEST_CASE("preferences: what cannot be written is forgotten without a word") {
  const auto folder = scratch_folder("preferences_test");
  std::ofstream(folder / "file") << "no folder";
  CHECK_NOTHROW(write_preferences(folder / "file" / "window.txt", {}));
  CHECK_NOTHROW(write_preferences({}, {}));
}

TEST_CASE("preferences: texts grow and shrink by steps, up to the ends") {
  Preferences preferences;
  step_text_size(preferences, 1);
  CHECK(preferences.text_size == 1.1);
  step_text_size(preferences, -2);
  CHECK(preferences.text_size == 0.9);
  step_text_size(preferences, 9);
  CHECK(preferences.text_size == 2);
  step_text_size(preferences, -9);
  CHECK(preferences.text_size == 0.8);
}

}  // namespace tyndall::test::preferences_test
