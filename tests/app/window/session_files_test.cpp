#include "app/window/document/document.h"
#include "core/image/image_io.h"
#include "core/image/tonemap.h"
#include "tests/app/window/opened_session.h"

#include <cmath>

namespace tyndall::test::session_files_test {
namespace fs = std::filesystem;

TEST_CASE("the file is read again when it changes, also from a broken one; with edits the user is asked first") {
  OpenedSession opened("reload");
  OpenedSession::write(0.625);
  REQUIRE(opened.becomes(0.625));
  opened.set_fuzz(0.5);
  Editor& editor = opened.editor();
  const auto answers = [&](double changed_to, bool takes) {
    OpenedSession::write(changed_to);
    REQUIRE(opened.comes_true([&] { return editor.offers_reload(); }));
    CHECK(opened.fuzz() == 0.5);
    editor.answer_about_file(takes);
    CHECK(opened.fuzz() == (takes ? changed_to : 0.5));
    CHECK(OpenedSession::fuzz_of(editor.document().origin->saved) == changed_to);
    CHECK(editor.edited() != takes);
  };
  answers(0.75, false);
  answers(0.875, true);
  CHECK_FALSE(file_differs(*editor.document().origin));
  editor.undo();
  CHECK(opened.fuzz() == 0.5);
  write_text("scene.json", "{");
  REQUIRE(opened.complains());
  const std::string told = opened.message();
  opened.set_fuzz(0.75);
  CHECK(opened.message() == told);
  CHECK(opened.fuzz() == 0.75);
  CHECK(file_differs(*editor.document().origin));
  editor.save(editor.document().origin->file);  // as the user wished, after being asked
  CHECK_FALSE(file_differs(*editor.document().origin));
  opened.set_fuzz(0.625);
  CHECK_FALSE(opened.session->messages.current().error);
}

TEST_CASE("edits that are not saved come back in the next session, and one undo goes back to the file") {
  OpenedSession opened("restore");
  opened.set_fuzz(0.5);
  opened.reopen();
  CHECK(opened.fuzz() == 0.5);
  CHECK(opened.message().starts_with("restored the edits of scene.json"));
  OpenedSession::write(0.125, "other.json");
  opened.reopen([](WindowOptions& options) { options.scene = load_scene("other.json"); });
  CHECK(opened.fuzz() == 0.125);
  CHECK(opened.message().starts_with("there are edits of "));
  CHECK(opened.message().find("scene.json that were not saved") != std::string::npos);
  opened.reopen();
  opened.editor().undo();
  CHECK(opened.fuzz() == 0.25);
  opened.reopen();  // undone edits are none
  CHECK(opened.fuzz() == 0.25);
  opened.set_fuzz(0.75);
  opened.session->keep_edits();
  opened.session->discard_edits();
  opened.reopen();
  CHECK(opened.fuzz() == 0.25);
}

TEST_CASE("restored edits of a file that another program has changed since wait for the user's answer") {
  OpenedSession opened("restore_changed");
  opened.set_fuzz(0.5);
  opened.session->keep_edits();
  opened.session.reset();
  OpenedSession::write(0.75);
  opened.open();
  Editor& editor = opened.editor();
  CHECK(opened.fuzz() == 0.5);
  REQUIRE(editor.offers_reload());
  editor.answer_about_file(true);
  CHECK(opened.fuzz() == 0.75);
  CHECK_FALSE(editor.edited());
  editor.undo();
  CHECK(opened.fuzz() == 0.5);
}

TEST_CASE("where edits cannot be kept as usual it is said once, with the reason, and when they can be again") {
  OpenedSession opened("keeping");
  const auto keeps = [&](const std::string& scene, double fuzz) {
    setenv("XDG_STATE_HOME", fs::absolute("file/state").c_str(), 1);
    write_text("file", "no folder");
    opened.open([&](WindowOptions& options) { options.scene = load_scene(scene); });
    opened.session->editor.edit(
        [&] {
          Scene edited = opened.scene();
          edited.camera.vfov = fuzz;
          return edited;
        }(),
        0);
    opened.session->keep_edits();
    opened.session->flush_edits();
    opened.session->collect();
    return opened.message();
  };
  const std::string beside = keeps("scene.json", 33);
  CHECK(beside.starts_with("edits are kept in " + fs::absolute(".scene.json.unsaved-1").string() + ", because of: "));
  CHECK(beside.find("Not a directory") != std::string::npos);
  opened.session->messages.dismiss();
  opened.set_fuzz(0.75);
  opened.session->keep_edits();
  opened.session->flush_edits();
  opened.session->collect();
  CHECK(opened.message().empty());
  const std::string lost = keeps("showroom", 35);
  CHECK(lost.starts_with("edits cannot be kept: "));
  CHECK(lost.find("lost when the window ends") != std::string::npos);
  fs::remove("file");
  opened.session->flush_edits();
  opened.session->collect();
  CHECK(opened.message() == "edits can be kept again, and are");
}

namespace {

/// A session over a scene with a texture of one pixel.
struct TexturedSession : OpenedSession {
  explicit TexturedSession(const std::string& name) : OpenedSession(name) {
    paint("map.png", 0.25f);
    write_textured("map.png");
    editor().open(fs::absolute("textured.json").string());
    REQUIRE(comes_true([&] { return editor().document().origin->title == "textured.json"; }));
    REQUIRE(shows(137));
  }
  static void paint(const std::string& file, float red) { write_png(file, {1, 1, {red, 0, 0}}, 0, ToneMap::srgb, {}); }
  static void write_textured(const std::string& map) {
    write_text("textured.json", R"({ "tyndall": 1, "image": { "width": 8, "height": 8 }, "background": [1, 1, 1],
      "render": { "spp": 1 }, "textures": { "map": { "type": "image", "file": ")" +
                                    map + R"(" } },
      "materials": { "land": { "type": "lambertian", "albedo": "map" } },
      "objects": [{ "type": "sphere", "center": [0, 0, -2], "radius": 1, "material": "land" }] })");
  }
  /// Of the texture that is shown, as the byte of a picture file.
  int red() const {
    return static_cast<int>(std::lround(255 * srgb_encode(std::get<Image>(scene().textures[0].kind).pixels->rgb[0])));
  }
  bool shows(int red_byte) {
    return comes_true([&] { return red() == red_byte && !session->messages.current().error; }) && finishes();
  }
};

}  // namespace

TEST_CASE("textures are read again when they are written, renamed over, or come back") {
  TexturedSession opened("watched_textures");
  const std::uint64_t edit = opened.sent();
  opened.paint("other.png", 0.5f);
  write_text("map.png", read_text("other.png"));  // in place
  REQUIRE(opened.shows(188));
  CHECK(opened.sent() > edit);
  opened.paint("other.png", 1);
  fs::rename("other.png", "map.png");
  REQUIRE(opened.shows(255));
  fs::rename("map.png", "away.png");
  REQUIRE(opened.complains());
  CHECK(opened.message().find("map.png") != std::string::npos);
  CHECK(opened.red() == 255);
  fs::rename("away.png", "map.png");
  REQUIRE(opened.shows(255));
  write_text("map.png", "no picture");
  REQUIRE(opened.complains());
  CHECK(opened.red() == 255);
  opened.paint("map.png", 0.25f);
  REQUIRE(opened.shows(137));
}

TEST_CASE("a texture that is painted anew is no edit: edits of the scene stay, and undo shows the new picture, too") {
  TexturedSession opened("texture_and_edits");
  opened.edit([](Scene& scene) { scene.camera.vfov = 30; });
  opened.paint("map.png", 0.5f);
  REQUIRE(opened.shows(188));
  CHECK_FALSE(opened.editor().offers_reload());
  CHECK(opened.scene().camera.vfov == 30);
  opened.editor().undo();
  CHECK(opened.red() == 188);
  CHECK_FALSE(opened.editor().edited());
  opened.editor().redo();
  CHECK(opened.scene().camera.vfov == 30);
}

TEST_CASE("a scene that names a texture before it is there is read when it comes") {
  TexturedSession opened("texture_to_come");
  opened.write_textured("maps/new.png");
  REQUIRE(opened.complains());
  REQUIRE(opened.comes_true([&] { return !opened.editor().file_changed(); }));
  fs::create_directory("maps");
  opened.paint("maps/new.png", 1);
  REQUIRE(opened.shows(255));
  write_text("textured.json", "{");
  REQUIRE(opened.complains());
  opened.write_textured("maps/new.png");  // as it was: the message goes, too
  REQUIRE(opened.shows(255));
}

TEST_CASE("a scene behind a symbolic link is read again when its target is saved or the link leads elsewhere") {
  OpenedSession opened("link");
  fs::create_directory("in");
  OpenedSession::write(0.125, "in/a.json");
  OpenedSession::write(0.875, "in/b.json");
  fs::create_symlink("in/a.json", "link.json");
  REQUIRE(opened.opens("link.json", 0.125));
  OpenedSession::write(0.375, "in/a.json");
  REQUIRE(opened.becomes(0.375));
  OpenedSession::write(0.625, "in/new.json");
  fs::rename("in/new.json", "in/a.json");
  REQUIRE(opened.becomes(0.625));
  fs::create_symlink("in/b.json", "next.json");
  fs::rename("next.json", "link.json");
  REQUIRE(opened.becomes(0.875));
  opened.set_fuzz(0.5);
  CHECK(opened.editor().save(opened.editor().document().origin->file));
  CHECK(fs::is_symlink("link.json"));
  CHECK(OpenedSession::fuzz_in("in/b.json") == 0.5);
}

TEST_CASE("a scene with textures can be saved to other folders again and again") {
  TexturedSession opened("textures");
  fs::create_directories("in/deep");
  Editor& editor = opened.editor();
  const auto change = [](Scene& scene) { scene.camera.vfov -= 1; };
  for (const char* file : {"in/copy.json", "in/copy.json", "in/deep/copy.json", "textured.json"}) {
    opened.edit(change);
    editor.save(file);
    CHECK_FALSE(editor.edited());
    CHECK(load_scene(file).scene == editor.scene());
    opened.edit(change);
    opened.session->keep_edits();
    opened.session->flush_edits();
  }
  editor.undo();
  editor.undo();
  editor.save("in/deep/older.json");
  CHECK(load_scene("in/deep/older.json").scene.camera.vfov == editor.scene().camera.vfov);
  opened.session->snapshot();
  REQUIRE(opened.appears("older-001.png"));
  CHECK(load_scene("older-001.png").scene.textures.size() == 1);
}

TEST_CASE("saving is no edit, and is not read again as one") {
  OpenedSession opened("save");
  Editor& editor = opened.editor();
  CHECK_FALSE(editor.edited());
  opened.set_fuzz(0.5);
  CHECK(editor.edited());
  REQUIRE(opened.finishes());
  const std::uint64_t edits = opened.sent();
  editor.save(editor.document().origin->file);
  CHECK_FALSE(editor.edited());
  const auto saved = editor.document().origin;
  REQUIRE(opened.comes_true([&] { return editor.document().origin != saved; }));  // the file was read again
  REQUIRE(opened.finishes());
  CHECK(opened.sent() == edits);
  CHECK(OpenedSession::fuzz_in("scene.json") == 0.5);
  editor.save("no/such/folder/a.json");
  CHECK(opened.session->messages.current().error);
}

TEST_CASE("snapshots hold the newest edit, are finished when the window closes, and missed where the folder is gone") {
  OpenedSession opened("snapshot");
  opened.session->export_chart();
  CHECK(opened.message() == "there is no curve yet");
  REQUIRE(opened.finishes());
  opened.show();
  for (int k = 0; k < 2; ++k) opened.session->export_chart();
  REQUIRE(opened.appears("scene-chart-002.svg"));
  CHECK(fs::exists("scene-chart-001.csv"));
  opened.set_fuzz(0.875);
  opened.session->snapshot();  // the edit was not sent yet
  REQUIRE(opened.appears("scene-001.png"));
  CHECK(OpenedSession::fuzz_in("scene-001.png") == 0.875);
  opened.session->snapshot();
  opened.open();
  CHECK(fs::exists("scene-002.png"));
  REQUIRE(opened.finishes());
  opened.show();
  const fs::path folder = fs::current_path();
  fs::remove_all(folder);
  opened.session->export_chart();
  REQUIRE(opened.complains());
  CHECK(opened.message().find("scene-chart-001.csv: cannot write") != std::string::npos);
  opened.session->messages.dismiss();
  opened.session->snapshot();
  CHECK(opened.session->finish_files().find("scene-001.png: cannot write") != std::string::npos);
  fs::create_directories(folder);
}

}  // namespace tyndall::test::session_files_test
