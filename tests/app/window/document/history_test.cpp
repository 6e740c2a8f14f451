#include "app/window/document/editor.h"

#include <doctest/doctest.h>

namespace tyndall::test::history_test {

namespace {

std::shared_ptr<Origin> origin_of(const char* what, int saved_width) {
  auto origin = std::make_shared<Origin>();
  origin->what = what;
  origin->saved.width = saved_width;
  return origin;
}
Document numbered(int n, const std::shared_ptr<const Origin>& origin = nullptr) {
  Scene scene;
  scene.width = n;
  return {scene, origin};
}

/// The history of a scene that is but a number.
struct Numbers : History {
  Numbers() : History(numbered(1)) {}
  void record_all(const std::vector<int>& numbers, std::uint64_t gesture = 0) {
    for (const int n : numbers) record(numbered(n), gesture);
  }
  int now() const { return current().scene.width; }
  /// The numbers of so many steps back; less if there are not so many.
  std::vector<int> back(int steps) {
    std::vector<int> seen;
    for (int k = 0; k < steps && undo(); ++k) seen.push_back(now());
    return seen;
  }
};

}  // namespace

TEST_CASE("undo goes back through single edits, or whole drags, and redo forward again; the same value is no step") {
  Numbers history;
  CHECK_FALSE(history.record(numbered(1), 1));
  CHECK_FALSE(history.can_undo());
  CHECK(history.record(numbered(2), 1));
  CHECK(history.record(numbered(3), 2));
  history.record_all({4, 5});  // no part of a gesture
  history.record_all({6, 7, 8}, 7);
  history.record_all({9, 10}, 8);
  CHECK(history.back(9) == std::vector<int>{8, 5, 4, 3, 2, 1});
  CHECK(history.redo());
  CHECK(history.now() == 2);
  while (history.redo()) {
  }
  CHECK(history.now() == 10);
}

TEST_CASE("an edit after undo forgets what was undone, and does not join the drag before") {
  Numbers history;
  history.record_all({2}, 5);
  history.record_all({3}, 6);
  history.undo();
  history.record_all({4}, 6);
  CHECK_FALSE(history.can_redo());
  CHECK(history.now() == 4);
  CHECK(history.back(1) == std::vector<int>{2});
}

TEST_CASE("a drag that ends where it began leaves no step") {
  Numbers history;
  history.record_all({2}, 1);
  history.record_all({3, 4, 3, 2}, 7);
  CHECK(history.now() == 2);
  CHECK(history.back(1) == std::vector<int>{1});
  CHECK(history.redo());
  CHECK(history.now() == 2);
  CHECK_FALSE(history.redo());
  history.record_all({3, 2, 5}, 8);  // goes through where it began
  CHECK(history.back(1) == std::vector<int>{2});
}

TEST_CASE("the oldest steps are forgotten") {
  Numbers history;
  for (int n = 2; n <= 1000; ++n) history.record_all({n});
  const std::vector<int> seen = history.back(1000);
  CHECK(seen.size() == History::max_steps - 1);
  CHECK(seen.back() == 1001 - static_cast<int>(History::max_steps));
}

TEST_CASE("saving changes what all steps of the file are compared with; edits that no file has are found") {
  const auto first = origin_of("first", 0), other = origin_of("other", 0);
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
  CHECK(history.current().scene.width == 1);
  const auto saved = origin_of("first", 1);
  history.set_origin(saved);
  CHECK_FALSE(edited(history.current()));
  CHECK(history.unsaved() == nullptr);
  history.undo();
  CHECK(history.current().origin == saved);
  CHECK(edited(history.current()));
  CHECK(history.unsaved()->scene.width == 0);
  history.redo();
  history.redo();
  CHECK(history.current().origin == other);
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
