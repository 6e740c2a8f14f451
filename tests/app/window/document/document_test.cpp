#include "app/window/document/document.h"
#include "app/window/document/editor.h"
#include "tests/app/window/scenes.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

namespace tyndall::test::document_test {
namespace fs = std::filesystem;

TEST_CASE("comments are found, slashes in strings are none") {
  CHECK(has_comments("{ \"a\": 1 } // one"));
  CHECK(has_comments("/* one */ {}"));
  CHECK_FALSE(has_comments("{ \"file\": \"a/b//c\", \"x\": \"\\\"/\" }"));
  CHECK_FALSE(has_comments("{}"));
}

TEST_CASE("a saved scene reads back equal, from another folder too; names and display make no other picture") {
  const fs::path folder = scratch_folder("saved_scene");
  Document document = document_of(load_scene("earth"));
  Scene& scene = document.scene;
  const Scene before = scene;
  scene.name = "A \"name\"";
  scene.display.exposure = 1;
  CHECK(same_picture(scene, before));
  scene.camera.vfov = 50;
  CHECK_FALSE(same_picture(scene, before));
  const auto origin = save_document(document, folder / "copy.json");
  CHECK(origin->title == "copy.json");
  CHECK_FALSE(origin->comments);
  const LoadedScene again = load_scene((folder / "copy.json").string());
  CHECK(again.scene.name == scene.name);
  CHECK(again.scene == origin->saved);
  CHECK_THROWS_AS(save_document(document, folder / "none" / "copy.json"), std::exception);
}

TEST_CASE("titles are one line; names for snapshots leave out the number, and leave room for numbers and endings") {
  CHECK(title_of("folder/cornell.json") == "cornell.json");
  CHECK(title_of("a\nb\x1b\xff.json") == "a\\nb\\u001b\\xff.json");
  const fs::path file = scratch_folder("odd_titles") / "line\nfeed.json";
  const auto origin = save_document(document_of(load_scene("cornell-box")), file);
  CHECK(origin->title == "line\\nfeed.json");
  CHECK(origin->file == file);
  CHECK(document_of(load_scene(file.string())).origin->title == "line\\nfeed.json");
  std::string long_title, long_stem;
  for (int k = 0; k < 125; ++k) long_title += "ä", long_stem += k < 100 ? "ä" : "";
  for (const auto& [title, stem] : {std::pair<std::string, std::string>{"showroom", "showroom"},
                                    {"showroom-012.png", "showroom"},
                                    {"my-scene.json", "my-scene"},
                                    {"-", "scene"},
                                    {long_title, long_stem + "…"}})
    CHECK(stem_of(title) == stem);
}

namespace {

Object at(const std::string& name, double x) { return ball(name, {x, 0, 0}); }
Object pair(const std::vector<Object>& objects) { return {"pair", Group{objects}, {}}; }

}  // namespace

TEST_CASE("objects are found again where they stand now, with other values, names and neighbours") {
  const Scene before = scene_of({at("a", 0), at("b", 5), at("", 7), pair({at("c", 10), at("d", 15)})});
  Scene after = before;
  shape(after).radius = 3;
  after.objects[1].name = "other";
  CHECK(paths_after(before, after, {{1}, {0}, {3, 1}}) == ObjectPaths{{1}, {0}, {3, 1}});
  after.objects.insert(after.objects.begin(), at("new", 1));
  after.objects.push_back(at("last", 1));
  CHECK(paths_after(before, after, {{0}, {2}, {3, 1}}) == ObjectPaths{{1}, {3}, {4, 1}});
  CHECK(paths_after(before, after, {{1}}).empty());  // neither its name nor all of its values are there
  CHECK(paths_after(before, {}, {{0}, {3, 1}, {9}}).empty());
}

TEST_CASE("of equal objects each is found by its number, of those without names by their neighbours") {
  Scene before = scene_of({at("", 0), at("", 0), at("b", 2), at("", 4), at("", 4)});
  Scene after = scene_of({at("", 0), at("b", 2), at("", 4)});
  CHECK(paths_after(before, after, {{1}, {4}}).empty());
  CHECK(paths_after(before, after, {{0}, {3}}) == ObjectPaths{{0}, {2}});
  CHECK(paths_after(after, before, {{2}}) == ObjectPaths{{3}});
  before.objects = {at("", 0), at("", 1), at("", 2)};
  after.objects = {at("", 9), at("", 0), at("", 8), at("", 2)};
  CHECK(paths_after(before, after, {{1}}).empty());
  after.objects[1] = at("", 1);
  CHECK(paths_after(before, after, {{2}, {1}}) == ObjectPaths{{3}, {1}});
}

TEST_CASE("keys follow their objects, and go with them") {
  Scene before = scene_of({at("a", 0), pair({at("b", 1), at("c", 2)})});
  before.animation.emplace();
  for (const char* row : {"/objects/0/radius", "/objects/1/objects/1/radius"})
    set_key(*before.animation, row, {0, {1}});
  Scene after = before;
  after.objects.erase(after.objects.begin());
  move_keys(before, after);
  REQUIRE(after.animation);
  REQUIRE(after.animation->keyed.size() == 1);
  CHECK(after.animation->keyed[0].pointer == "/objects/0/objects/1/radius");
}

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

}  // namespace tyndall::test::document_test
