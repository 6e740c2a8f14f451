#include "app/window/document/autosave.h"
#include "app/window/document/document.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>

namespace tyndall::test::autosave_test {
namespace fs = std::filesystem;

namespace {

using Edited = std::shared_ptr<const Document>;

Edited with_vfov(Document document, double vfov) {
  document.scene.camera.vfov = vfov;
  return std::make_shared<const Document>(std::move(document));
}
/// A document of a scene file in the folder, with an edit.
Edited edited_document(const fs::path& folder, const std::string& name, double vfov) {
  write_text(folder / name, R"({ "tyndall": 1, "image": { "width": 8, "height": 8 }, "objects": [] })");
  return with_vfov(document_of(load_scene((folder / name).string())), vfov);
}
/// Edits of a scene that was built in, or came by standard input (""): it has no folder that could be written.
Edited edited_elsewhere(const std::string& what, double vfov = 33) {
  Document document = document_of(load_scene("showroom"));
  auto origin = std::make_shared<Origin>(*document.origin);
  origin->what = what;
  document.origin = std::move(origin);
  return with_vfov(std::move(document), vfov);
}

/// A window that keeps edits in a state folder.
struct Window : Autosave {
  using Autosave::Autosave;
  void keep(const Edited& document) {
    Autosave::keep(std::make_shared<const Scene>(document->scene), document->origin);
    flush();
  }
  /// What was edited is in a file, or the user does not want it.
  void forget() {
    Autosave::keep(nullptr, nullptr);
    flush();
  }
  bool says(const std::string& part) const { return last_words().find(part) != std::string::npos; }
};

Kept read_all(const fs::path& file) {
  return read_kept(file, [](const std::string& what) { return load_scene(what); });
}
Scene read(const fs::path& file) { return read_all(file).document.scene; }

/// A state folder that can be neither made nor written, whoever tries.
fs::path no_folder(const fs::path& folder) {
  write_text(folder / "file", "no folder");
  return folder / "file" / "tyndall";
}
/// No file can be replaced by a folder: as where no room is left. It can be removed, unless it holds something.
void block(const fs::path& file, const std::string& with = "") {
  fs::remove(file);
  fs::create_directories(file / with);
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

TEST_CASE("edits are kept in a file that is a scene and says what it is an edit of") {
  const fs::path folder = scratch_folder("kept_text"), file = folder / "kept.json";
  const auto document = edited_document(folder, "a%\n.json", 33);
  write_text(file, kept_text(document->scene, *document->origin, folder));
  CHECK(load_scene(file.string()).scene.camera.vfov == 33);
  CHECK(kept_what(file) == document->origin->what);
  const Document again = read_all(file).document;
  CHECK(again.scene == document->scene);
  CHECK(again.origin->file == document->origin->file);
  CHECK(edited(again));
  CHECK_FALSE(read_all(file).file_changed);
  std::ofstream(document->origin->file, std::ios::app) << "\n";
  CHECK(read_all(file).file_changed);
  fs::remove(document->origin->file);
  CHECK(read(file) == document->scene);
  CHECK_FALSE(read_all(file).file_changed);  // there is none to take
}

TEST_CASE("what one window has kept is taken over by the next, but not while the first is open") {
  const fs::path folder = scratch_folder("kept_windows"), state = folder / "state";
  const auto one = edited_document(folder, "one.json", 31), two = edited_document(folder, "two.json", 32);
  {
    Window first(state), second(state), third(state);
    first.keep(one);
    second.keep(two);
    CHECK(first.keeping().kind == Keeping::Kind::kept);
    CHECK(first.last_words() == "the edits of one.json are kept and come back at the next start with this scene");
    CHECK(third.take_over("").empty());
    CHECK(third.others().empty());
  }
  Window next(state);
  CHECK(next.take_over("showroom").empty());
  CHECK(next.others().size() == 2);
  const fs::path file = next.take_over(one->origin->what);
  REQUIRE(!file.empty());
  CHECK(read(file) == one->scene);
  CHECK(next.others() == std::vector<std::string>{two->origin->what});
  next.forget();
  CHECK_FALSE(fs::exists(file));
}

TEST_CASE("a broken file of kept edits is left as it is") {
  const fs::path folder = scratch_folder("kept_broken");
  write_text(folder / "unsaved-1.json", "// Edits that were not saved, of showroom\n{");
  {
    Window kept(folder);
    CHECK_THROWS(read(kept.take_over("showroom")));
    kept.leave();
    const auto document = edited_document(folder, "scene.json", 20);
    kept.Autosave::keep(std::make_shared<const Scene>(document->scene), document->origin);  // written at the end
  }
  CHECK(fs::file_size(folder / "unsaved-1.json") < 60);
  CHECK(fs::exists(folder / "unsaved-2.json"));
}

TEST_CASE("where the state folder cannot be written or has no name, edits are kept beside the scene and come back") {
  for (const bool named : {true, false}) {
    CAPTURE(named);
    const fs::path folder = scratch_folder("kept_beside"), scenes = folder / "scenes";
    fs::create_directory(scenes);
    const fs::path state = named ? no_folder(folder) : fs::path();
    const auto document = edited_document(scenes, "scene.json", 31);
    const std::string what = document->origin->what;
    std::atomic<int> changes = 0;
    {
      Window kept(state, [&changes] { ++changes; });
      kept.keep(document);
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
    Window next(state);
    CHECK(next.take_over("").empty());
    const fs::path file = next.take_over(what);
    REQUIRE(!file.empty());
    CHECK(read(file) == document->scene);
    CHECK(Window(state).take_over(what).empty());  // that window has it
    next.keep(edited_document(scenes, "scene.json", 32));
    CHECK(read(file).camera.vfov == 32);
    next.forget();
    CHECK(next.last_words().empty());
    CHECK_FALSE(fs::exists(file));
  }
}

TEST_CASE("edits that can be kept nowhere are lost, and that is said with the reason; scenes without a folder, too") {
  const fs::path folder = scratch_folder("kept_nowhere");
  for (const char* what : {"showroom", ""}) {
    CAPTURE(what);
    Window nowhere(no_folder(folder));
    nowhere.keep(edited_elsewhere(what));
    CHECK(nowhere.keeping().kind == Keeping::Kind::lost);
    CHECK(nowhere.says("the edits of showroom are lost: "));
    CHECK(nowhere.says("Not a directory"));
    CHECK(nowhere.take_over("").empty());
  }
  Window nameless("");
  CHECK(nameless.last_words().empty());
  nameless.keep(edited_elsewhere("showroom"));
  CHECK(nameless.says("neither XDG_STATE_HOME nor HOME names a folder"));
  Window both(no_folder(folder));
  both.keep(edited_elsewhere((folder / "file" / "scene.json").string()));  // neither here nor there
  CHECK(both.keeping().kind == Keeping::Kind::lost);
  CHECK(names_in(folder) == std::vector<std::string>{"file"});
}

TEST_CASE("a folder that can be written again, as after a full disk, is written again, and older edits go") {
  const fs::path folder = scratch_folder("kept_again");
  Window kept(folder / "state");
  kept.keep(edited_elsewhere("showroom"));
  CHECK(kept.keeping().kind == Keeping::Kind::kept);
  const fs::path file = kept.keeping().file;
  block(file, "in the way");
  kept.keep(edited_elsewhere("showroom", 44));
  CHECK(kept.keeping().kind == Keeping::Kind::lost);
  CHECK(kept.says("the newest edits of showroom are lost ("));
  CHECK(kept.says("; older ones are kept and come back at the next start with this scene"));
  fs::remove_all(file);
  kept.flush();  // as at the end of the program
  CHECK(kept.keeping().kind == Keeping::Kind::kept);
  CHECK(read(file).camera.vfov == 44);
  block(file, "cannot be removed");
  kept.forget();
  CHECK(kept.says("edits that were saved or given up are still in " + file.string()));
  fs::remove_all(file);
  kept.flush();
  CHECK(kept.last_words().empty());
}

TEST_CASE("edits go on beside the scene when the state folder fails later, and only the newest are there then") {
  const fs::path folder = scratch_folder("kept_moves"), scenes = folder / "scenes";
  fs::create_directory(scenes);
  Window kept(folder / "state");
  kept.keep(edited_document(scenes, "scene.json", 31));
  const fs::path before = kept.keeping().file;
  block(before);
  kept.keep(edited_document(scenes, "scene.json", 32));
  CHECK(kept.keeping().kind == Keeping::Kind::beside);
  CHECK_FALSE(fs::exists(before));
  CHECK(read(scenes / ".scene.json.unsaved-1").camera.vfov == 32);
}

TEST_CASE("the last words promise no more than the next start does, with several windows or a file that is gone") {
  const fs::path folder = scratch_folder("kept_two"), state = folder / "state";
  const auto document = edited_document(folder, "scene.json", 31);
  const std::string kept = "the edits of scene.json are kept";
  {
    Window first(state), second(state);
    for (Window* window : {&first, &second}) window->keep(document);
    for (Window* window : {&first, &second})
      CHECK(window->last_words() == kept +
                                        ", and so are others; each start with this scene brings back the newest that "
                                        "no window has");
  }
  {
    Window first(state), second(state), third(state);
    CHECK_FALSE(first.take_over(document->origin->what).empty());
    CHECK_FALSE(second.take_over(document->origin->what).empty());
    CHECK(third.take_over(document->origin->what).empty());
    for (Window* window : {&first, &second}) window->forget();
  }
  Window window(state), apart(no_folder(folder)), other(state);
  for (Window* one : {&window, &apart}) one->keep(document);
  fs::remove(folder / "scene.json");
  CHECK(window.last_words() == kept + " and come back at the next start without a scene");
  const std::string beside = (folder / ".scene.json.unsaved-1").string();
  CHECK(apart.last_words() == kept + " in " + beside + ", which opens as a scene; the one that was edited is gone");
  CHECK(load_scene(beside).scene.camera.vfov == 31);
  other.keep(edited_elsewhere("showroom"));
  CHECK(window.last_words() == kept +
                                   ", and so are others; each start without a scene brings back the newest that no "
                                   "window has");
}

TEST_CASE("the state folder: relative paths in the environment are no folders") {
  const auto now = [](const char* variable) { return std::string(std::getenv(variable) ? std::getenv(variable) : ""); };
  const std::string before = now("XDG_STATE_HOME"), home = now("HOME");
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

}  // namespace tyndall::test::autosave_test
