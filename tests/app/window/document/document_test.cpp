#include "app/window/document/document.h"
#include "app/window/document/editor.h"
#include "tests/app/window/scenes.h"
#include "tests/support/scratch.h"

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

}  // namespace tyndall::test::document_test
