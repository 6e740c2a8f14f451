#include "app/window/document/editor.h"

#include <doctest/doctest.h>

namespace tyndall::test::history_test {

namespace {

Document numbered(int n, const std::shared_ptr<const Origin>& origin = nullptr) {
  Scene scene;
  scene.width = n;
  return {scene, origin};
}

int number(const History& history) { return history.current().scene.width; }

}  // namespace

TEST_CASE("undo goes back through single edits and redo forward again") {
  History history(numbered(1));
  CHECK(history.record(numbered(2), 1));
  CHECK(history.record(numbered(3), 2));
  CHECK(history.undo());
  CHECK(number(history) == 2);
  CHECK(history.undo());
  CHECK(number(history) == 1);
  CHECK_FALSE(history.undo());
  CHECK(history.redo());
  CHECK(history.redo());
  CHECK(number(history) == 3);
  CHECK_FALSE(history.redo());
}

TEST_CASE("undo takes back a whole drag at once, and the next drag apart from it") {
  History history(numbered(1));
  for (int n = 2; n <= 9; ++n) history.record(numbered(n), 7);
  for (int n = 10; n <= 19; ++n) history.record(numbered(n), 8);
  CHECK(number(history) == 19);
  history.undo();
  CHECK(number(history) == 9);
  history.undo();
  CHECK(number(history) == 1);
}

TEST_CASE("edits that are not part of a gesture are undone one by one") {
  History history(numbered(1));
  history.record(numbered(2), 0);
  history.record(numbered(3), 0);
  history.undo();
  CHECK(number(history) == 2);
}

TEST_CASE("setting a value to what it is already adds no step to undo") {
  History history(numbered(1));
  CHECK_FALSE(history.record(numbered(1), 1));
  CHECK_FALSE(history.can_undo());
}

TEST_CASE("an edit after undo forgets what was undone, and does not join the drag before") {
  History history(numbered(1));
  history.record(numbered(2), 5);
  history.record(numbered(3), 6);
  history.undo();
  history.record(numbered(4), 6);
  CHECK_FALSE(history.can_redo());
  CHECK(number(history) == 4);
  history.undo();
  CHECK(number(history) == 2);
}

TEST_CASE("the oldest steps are forgotten") {
  History history(numbered(0));
  for (int n = 1; n <= 1000; ++n) history.record(numbered(n), static_cast<std::uint64_t>(n));
  int steps = 0;
  while (history.undo()) ++steps;
  CHECK(steps == static_cast<int>(History::max_steps) - 1);
  CHECK(number(history) == 1000 - steps);
}

TEST_CASE("saving changes what all steps of the same file are compared with, and no others") {
  const auto first = std::make_shared<Origin>(), other = std::make_shared<Origin>();
  History history(numbered(1, first));
  history.record(numbered(2, first), 1);
  history.record(numbered(3, other), 2);
  history.undo();
  auto saved = std::make_shared<Origin>();
  saved->saved.width = 2;
  history.set_origin(saved);
  CHECK_FALSE(edited(history.current()));
  history.undo();
  CHECK(history.current().origin == saved);
  CHECK(edited(history.current()));
  history.redo();
  history.redo();
  CHECK(history.current().origin == other);
}

TEST_CASE("edits that no file has are found after another scene was opened, but not when they were saved") {
  const auto origin = [](const char* what) {
    auto made = std::make_shared<Origin>();
    made->what = what;
    made->saved.width = 0;
    return made;
  };
  const auto first = origin("first"), other = origin("other");
  History history(numbered(0, first));
  CHECK(history.unsaved() == nullptr);
  history.record(numbered(1, first), 1);
  REQUIRE(history.unsaved());
  CHECK(history.unsaved()->scene.width == 1);
  history.record(numbered(0, other), 0);
  REQUIRE(history.unsaved());
  CHECK(history.unsaved()->origin == first);
  history.record(numbered(3, other), 2);
  CHECK(history.unsaved()->origin == other);
  history.undo();
  history.go_to_unsaved();
  CHECK(number(history) == 1);
  auto saved = origin("first");
  saved->saved.width = 1;
  history.set_origin(saved);
  CHECK(history.unsaved() == nullptr);
  history.undo();
  CHECK(history.unsaved()->scene.width == 0);
}

TEST_CASE("a drag that ends where it began leaves no step") {
  History history(numbered(1));
  history.record(numbered(2), 1);
  for (const int n : {3, 4, 3, 2}) history.record(numbered(n), 7);
  CHECK(number(history) == 2);
  CHECK(history.undo());
  CHECK(number(history) == 1);
  CHECK(history.redo());
  CHECK(number(history) == 2);
  CHECK_FALSE(history.redo());
  for (const int n : {3, 2, 5}) history.record(numbered(n), 8);  // goes through where it began
  CHECK(history.undo());
  CHECK(number(history) == 2);
}

TEST_CASE("each step has its own selection, which undo and redo bring back, and only of what the scene has") {
  Document one = numbered(1), two = numbered(2);
  one.scene.objects.resize(3);
  two.scene.objects.resize(5);
  History history(one);
  history.select({{2}, {4}});
  CHECK(history.selection() == ObjectPaths{{2}});
  history.record(two, 0);
  CHECK(history.selection() == ObjectPaths{{2}});
  history.select({{4}, {3}});
  history.undo();
  CHECK(history.selection() == ObjectPaths{{2}});
  history.redo();
  CHECK(history.selection() == ObjectPaths{{4}, {3}});
  history.record(one, 0);
  CHECK(history.selection().empty());
}

}  // namespace tyndall::test::history_test
