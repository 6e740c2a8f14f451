#include "app/window/system/preferences.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

#include <fstream>

using namespace tyndall;

TEST_CASE("preferences: what was written is read; what is not said or not known has its default") {
  const auto folder = scratch_folder("preferences_test");
  const auto file = folder / "of" / "tyndall" / "window.txt";
  CHECK(read_preferences(file) == Preferences{});
  CHECK(Preferences{}.clean);
  write_preferences(file, {false});
  CHECK_FALSE(read_preferences(file).clean);
  write_preferences(file, {true});
  CHECK(read_preferences(file).clean);
  std::ofstream(file) << "clean perhaps\nother on\n";
  CHECK(read_preferences(file) == Preferences{});
  std::ofstream(file) << "other on\nclean off\n";
  CHECK_FALSE(read_preferences(file).clean);
}

TEST_CASE("preferences: what cannot be written is forgotten without a word") {
  const auto folder = scratch_folder("preferences_test");
  std::ofstream(folder / "file") << "no folder";
  CHECK_NOTHROW(write_preferences(folder / "file" / "window.txt", {}));
  CHECK_NOTHROW(write_preferences({}, {}));
}
