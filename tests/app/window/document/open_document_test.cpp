#include "app/window/document/document.h"

#include "tests/support/scratch.h"

#include <doctest/doctest.h>

#include <filesystem>

namespace tyndall::test::open_document_test {
namespace fs = std::filesystem;

TEST_CASE("comments are found, slashes in strings are none") {
  CHECK(has_comments("{ \"a\": 1 } // one"));
  CHECK(has_comments("/* one */ {}"));
  CHECK_FALSE(has_comments("{ \"file\": \"a/b//c\", \"x\": \"\\\"/\" }"));
  CHECK_FALSE(has_comments("{}"));
}

TEST_CASE("a saved scene reads back equal, from another folder too") {
  const fs::path folder = scratch_folder("saved_scene");
  Document document = document_of(load_scene("earth"));
  document.scene.name = "A \"name\"";
  const auto origin = save_document(document, folder / "copy.json");
  CHECK(origin->title == "copy.json");
  CHECK_FALSE(origin->comments);
  const LoadedScene again = load_scene((folder / "copy.json").string());
  CHECK(again.scene.name == document.scene.name);
  CHECK(again.scene == origin->saved);
  CHECK_THROWS_AS(save_document(document, folder / "none" / "copy.json"), std::exception);
}

TEST_CASE("names for snapshots: that of the scene, without its number") {
  CHECK(stem_of("showroom") == "showroom");
  CHECK(stem_of("showroom-012.png") == "showroom");
  CHECK(stem_of("my-scene.json") == "my-scene");
  CHECK(stem_of("-") == "scene");
}

TEST_CASE("titles are one line, and names for snapshots leave room for numbers and endings") {
  CHECK(title_of("folder/cornell.json") == "cornell.json");
  CHECK(title_of("a\nb\x1b\xff.json") == "a\\nb\\u001b\\xff.json");
  const fs::path file = scratch_folder("odd_titles") / "line\nfeed.json";
  const auto origin = save_document(document_of(load_scene("cornell-box")), file);
  CHECK(origin->title == "line\\nfeed.json");
  CHECK(origin->file == file);
  CHECK(document_of(load_scene(file.string())).origin->title == "line\\nfeed.json");
  std::string long_title, long_stem;
  for (int k = 0; k < 125; ++k) long_title += "ä", long_stem += k < 100 ? "ä" : "";
  CHECK(stem_of(long_title) == long_stem + "…");
}

}  // namespace tyndall::test::open_document_test
