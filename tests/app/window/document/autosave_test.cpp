#include "app/window/document/autosave.h"

#include "app/window/document/document.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace tyndall::test::autosave_test {
namespace fs = std::filesystem;

namespace {

/// A document of a scene file in the folder, with an edit.
std::shared_ptr<const Document> edited_document(const fs::path& folder, const std::string& name, double vfov) {
  std::ofstream(folder / name) << R"({ "tyndall": 1, "image": { "width": 8, "height": 8 }, "objects": [] })";
  Document document = document_of(load_scene((folder / name).string()));
  document.scene.camera.vfov = vfov;
  return std::make_shared<const Document>(std::move(document));
}

void keep(Autosave& kept, const Document& document) {
  kept.keep(std::make_shared<const Scene>(document.scene), document.origin);
  kept.flush();
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
    Autosave first(state), second(state);
    keep(first, *one);
    keep(second, *two);
    CHECK(first.keeping().kind == Keeping::Kind::kept);
    CHECK(first.last_words() == "the edits of one.json are kept and come back at the next start with this scene");
    Autosave third(state);
    CHECK(third.take_over("").empty());
    CHECK(third.others().empty());
  }
  Autosave next(state);
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
    Autosave kept(folder);
    const fs::path file = kept.take_over("showroom");
    CHECK_THROWS(read(file));
    kept.leave();
    const auto document = edited_document(folder, "scene.json", 20);
    kept.keep(std::make_shared<const Scene>(document->scene), document->origin);  // written at the end
  }
  CHECK(fs::file_size(folder / "unsaved-1.json") < 60);
  CHECK(fs::exists(folder / "unsaved-2.json"));
}

namespace {

/// Edits of a scene that was built in, or came by standard input (""): it has no folder that could be written.
std::shared_ptr<const Document> edited_elsewhere(const std::string& what) {
  Document document = document_of(load_scene("showroom"));
  auto origin = std::make_shared<Origin>(*document.origin);
  origin->what = what;
  document.origin = std::move(origin);
  document.scene.camera.vfov = 33;
  return std::make_shared<const Document>(std::move(document));
}

/// A state folder that can be neither made nor written, whoever tries.
fs::path no_folder(const fs::path& folder) {
  std::ofstream(folder / "file") << "no folder";
  return folder / "file" / "tyndall";
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

TEST_CASE("where the state folder cannot be written or has no name, edits are kept beside the scene and come back") {
  for (const bool named : {true, false}) {
    CAPTURE(named);
    const fs::path folder = scratch_folder("kept_beside"), scenes = folder / "scenes";
    fs::create_directory(scenes);
    const fs::path state = named ? no_folder(folder) : fs::path();
    const auto document = edited_document(scenes, "scene.json", 31);
    std::atomic<int> changes = 0;
    {
      Autosave kept(state, [&changes] { ++changes; });
      keep(kept, *document);
      const Keeping keeping = kept.keeping();
      CHECK(keeping.kind == Keeping::Kind::beside);
      CHECK(keeping.file == scenes / ".scene.json.unsaved-1");
      CHECK(keeping.why.find(named ? "file" : "HOME") != std::string::npos);
      CHECK(kept.last_words() == "the edits of scene.json are kept in " + keeping.file.string() +
                                     " and come back at the next start with this scene");
      CHECK(names_in(scenes).size() == 3);  // with the lock
    }
    CHECK(changes == 1);
    CHECK(names_in(scenes) == std::vector<std::string>{".scene.json.unsaved-1", "scene.json"});
    Autosave next(state);
    CHECK(next.take_over("").empty());
    const fs::path file = next.take_over(document->origin->what);
    REQUIRE(!file.empty());
    CHECK(read(file).scene == document->scene);
    CHECK(Autosave(state).take_over(document->origin->what).empty());  // that window has it
    keep(next, *edited_document(scenes, "scene.json", 32));
    CHECK(read(file).scene.camera.vfov == 32);
    next.keep(nullptr, nullptr);  // saved
    next.flush();
    CHECK(next.last_words().empty());
    CHECK_FALSE(fs::exists(file));
  }
}

TEST_CASE("edits that can be kept nowhere are lost, and that is said with the reason; scenes without a folder, too") {
  const fs::path folder = scratch_folder("kept_nowhere");
  for (const char* what : {"showroom", ""}) {
    CAPTURE(what);
    Autosave nowhere(no_folder(folder));
    keep(nowhere, *edited_elsewhere(what));
    CHECK(nowhere.keeping().kind == Keeping::Kind::lost);
    CHECK(nowhere.last_words().find("the edits of showroom are lost: ") == 0);
    CHECK(nowhere.last_words().find("Not a directory") != std::string::npos);
    CHECK(nowhere.take_over("").empty());
  }
  Autosave nameless("");
  CHECK(nameless.last_words().empty());
  keep(nameless, *edited_elsewhere("showroom"));
  CHECK(nameless.last_words().find("neither XDG_STATE_HOME nor HOME names a folder") != std::string::npos);
  const auto document = edited_document(folder, "scene.json", 31);
  auto origin = std::make_shared<Origin>(*document->origin);
  origin->what = (folder / "file" / "scene.json").string();  // neither here nor there
  Autosave both(no_folder(folder));
  both.keep(std::make_shared<const Scene>(document->scene), origin);
  both.flush();
  CHECK(both.keeping().kind == Keeping::Kind::lost);
  CHECK(names_in(folder) == std::vector<std::string>{"file", "scene.json"});
}

TEST_CASE("a folder that can be written again, as after a full disk, is written again, and older edits go") {
  const fs::path folder = scratch_folder("kept_again"), state = folder / "state";
  const auto first = edited_elsewhere("showroom");
  Autosave kept(state);
  keep(kept, *first);
  CHECK(kept.keeping().kind == Keeping::Kind::kept);
  // No file can be replaced by a folder that holds something: as where no room is left, the older edits stay.
  const fs::path file = kept.keeping().file;
  fs::rename(file, folder / "older");
  fs::create_directories(file / "in the way");
  Document newer = *first;
  newer.scene.camera.vfov = 44;
  keep(kept, newer);
  CHECK(kept.keeping().kind == Keeping::Kind::lost);
  CHECK(kept.last_words().find("the newest edits of showroom are lost (") == 0);
  CHECK(kept.last_words().find("; older ones are kept and come back at the next start with this scene") !=
        std::string::npos);
  fs::remove_all(file);
  kept.flush();  // as at the end of the program
  CHECK(kept.keeping().kind == Keeping::Kind::kept);
  CHECK(read(file).scene.camera.vfov == 44);
}

TEST_CASE("edits go on beside the scene when the state folder fails later, and only the newest are there then") {
  const fs::path folder = scratch_folder("kept_moves"), state = folder / "state", scenes = folder / "scenes";
  fs::create_directory(scenes);
  const auto document = edited_document(scenes, "scene.json", 31);
  Autosave kept(state);
  keep(kept, *document);
  const fs::path before = kept.keeping().file;
  fs::remove(before);
  fs::create_directories(before);  // no file takes the place of a folder, but it can be removed
  keep(kept, *edited_document(scenes, "scene.json", 32));
  CHECK(kept.keeping().kind == Keeping::Kind::beside);
  CHECK_FALSE(fs::exists(before));
  CHECK(read(scenes / ".scene.json.unsaved-1").scene.camera.vfov == 32);
}

TEST_CASE("edits that were given up and cannot be removed are said to come back") {
  const fs::path folder = scratch_folder("kept_stays"), state = folder / "state";
  Autosave kept(state);
  keep(kept, *edited_elsewhere("showroom"));
  const fs::path file = kept.keeping().file;
  fs::remove(file);
  fs::create_directories(file / "cannot be removed");
  kept.keep(nullptr, nullptr);
  kept.flush();
  CHECK(kept.last_words().find("edits that were saved or given up are still in " + file.string()) == 0);
  fs::remove_all(file);
  kept.flush();
  CHECK(kept.last_words().empty());
}

TEST_CASE("of two windows on one scene neither says that the next start brings its edits back: only the newest come") {
  const fs::path folder = scratch_folder("kept_two"), state = folder / "state";
  const auto document = edited_document(folder, "scene.json", 31);
  {
    Autosave first(state), second(state);
    keep(first, *document);
    keep(second, *document);
    for (const Autosave* window : {&first, &second})
      CHECK(window->last_words() ==
            "the edits of scene.json are kept, and so are others; each start with this "
            "scene brings back the newest that no window has");
  }
  Autosave first(state), second(state), third(state);
  CHECK_FALSE(first.take_over(document->origin->what).empty());
  CHECK_FALSE(second.take_over(document->origin->what).empty());
  CHECK(third.take_over(document->origin->what).empty());
}

TEST_CASE("the state folder: relative paths in the environment are no folders") {
  const std::string before = std::getenv("XDG_STATE_HOME") ? std::getenv("XDG_STATE_HOME") : "";
  const std::string home = std::getenv("HOME") ? std::getenv("HOME") : "";
  setenv("XDG_STATE_HOME", "relative/state", 1);
  setenv("HOME", "/home/somebody", 1);
  CHECK(state_folder() == "/home/somebody/.local/state/tyndall");
  setenv("HOME", "home", 1);
  CHECK(state_folder().empty());
  unsetenv("HOME");
  CHECK(state_folder().empty());
  setenv("XDG_STATE_HOME", "/var/state", 1);
  CHECK(state_folder() == "/var/state/tyndall");
  setenv("XDG_STATE_HOME", before.c_str(), 1);
  setenv("HOME", home.c_str(), 1);
}

TEST_CASE("edits of a scene whose file is gone: the last line promises no start with it") {
  const fs::path folder = scratch_folder("kept_gone"), state = folder / "state";
  const auto document = edited_document(folder, "scene.json", 31);
  Autosave kept(state), apart(no_folder(folder));
  keep(kept, *document);
  keep(apart, *document);
  fs::remove(folder / "scene.json");
  CHECK(kept.last_words() == "the edits of scene.json are kept and come back at the next start without a scene");
  const std::string beside = (folder / ".scene.json.unsaved-1").string();
  CHECK(apart.last_words() ==
        "the edits of scene.json are kept in " + beside + ", which opens as a scene; the one that was edited is gone");
  CHECK(load_scene(beside).scene.camera.vfov == 31);
  Autosave other(state);
  keep(other, *edited_elsewhere("showroom"));
  CHECK(kept.last_words() ==
        "the edits of scene.json are kept, and so are others; each start without a scene brings "
        "back the newest that no window has");
}

}  // namespace tyndall::test::autosave_test
