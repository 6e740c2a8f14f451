#include "app/window/document/kept_edits.h"

#include "app/window/document/open_document.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>

using namespace tyndall;
namespace fs = std::filesystem;

namespace {

/// A document of a scene file in the folder, with an edit.
std::shared_ptr<const Document> edited_document(const fs::path& folder, const std::string& name, double vfov) {
  std::ofstream(folder / name) << R"({ "tyndall": 1, "image": { "width": 8, "height": 8 }, "objects": [] })";
  Document document = document_of(load_scene((folder / name).string()));
  document.scene.camera.vfov = vfov;
  return std::make_shared<const Document>(std::move(document));
}

void keep(KeptEdits& kept, const Document& document) {
  kept.keep(std::make_shared<const Scene>(document.scene), document.origin);
}

Kept read_all(const fs::path& file) {
  return read_kept(file, [](const std::string& what) { return load_scene(what); });
}
Document read(const fs::path& file) { return read_all(file).document; }

}  // namespace

TEST_CASE("edits are kept in a file that is a scene and says what it is an edit of") {
  const fs::path folder = scratch_folder("kept_text");
  const auto document = edited_document(folder, "a%\n.json", 33);
  std::ofstream(folder / "kept.json") << kept_text(document->scene, *document->origin, folder);
  CHECK(load_scene((folder / "kept.json").string()).scene.camera.vfov == 33);
  CHECK(kept_what(folder / "kept.json") == document->origin->what);
  const Document again = read(folder / "kept.json");
  CHECK(again.scene == document->scene);
  CHECK(again.origin->file == document->origin->file);
  CHECK(edited(again));
  CHECK_FALSE(read_all(folder / "kept.json").file_changed);
  std::ofstream(document->origin->file, std::ios::app) << "\n";
  CHECK(read_all(folder / "kept.json").file_changed);
  fs::remove(document->origin->file);
  CHECK(read(folder / "kept.json").scene == document->scene);
  CHECK_FALSE(read_all(folder / "kept.json").file_changed);  // there is none to take
}

TEST_CASE("what one window has kept is taken over by the next, but not while the first is open") {
  const fs::path folder = scratch_folder("kept_windows"), state = folder / "state";
  const auto one = edited_document(folder, "one.json", 31), two = edited_document(folder, "two.json", 32);
  {
    KeptEdits first(state), second(state);
    keep(first, *one);
    keep(second, *two);
    first.flush();
    second.flush();
    CHECK(first.problem().empty());
    KeptEdits third(state);
    CHECK(third.take_over("").empty());
    CHECK(third.others().empty());
  }
  KeptEdits next(state);
  CHECK(next.take_over("showroom").empty());
  CHECK(next.others().size() == 2);
  const fs::path file = next.take_over(one->origin->what);
  REQUIRE(!file.empty());
  CHECK(read(file).scene == one->scene);
  CHECK(next.others() == std::vector<std::string>{two->origin->what});
  next.keep(nullptr, nullptr);  // saved
  next.flush();
  CHECK_FALSE(fs::exists(file));
}

TEST_CASE("a broken file of kept edits is left as it is") {
  const fs::path folder = scratch_folder("kept_broken");
  std::ofstream(folder / "unsaved-1.json") << "// Edits that were not saved, of showroom\n{";
  {
    KeptEdits kept(folder);
    const fs::path file = kept.take_over("showroom");
    CHECK_THROWS(read(file));
    kept.leave();
    keep(kept, *edited_document(folder, "scene.json", 20));
  }
  CHECK(fs::file_size(folder / "unsaved-1.json") < 60);
  CHECK(fs::exists(folder / "unsaved-2.json"));
}

TEST_CASE("without a folder nothing is kept, and a folder that cannot be made is told") {
  const fs::path folder = scratch_folder("kept_nowhere");
  KeptEdits nowhere("");
  keep(nowhere, *edited_document(folder, "scene.json", 20));
  nowhere.flush();
  CHECK(nowhere.take_over("").empty());
  std::ofstream(folder / "file") << "no folder";
  KeptEdits impossible(folder / "file");
  keep(impossible, *edited_document(folder, "scene.json", 20));
  impossible.flush();
  CHECK_FALSE(impossible.problem().empty());
}
