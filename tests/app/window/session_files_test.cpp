#include "app/window/document/document.h"
#include "core/image/image_io.h"
#include "core/image/tonemap.h"
#include "tests/app/window/opened_session.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

namespace tyndall::test::session_files_test {
using test::OpenedSession;
namespace fs = std::filesystem;

TEST_CASE("opening another scene can be undone, with where it came from") {
  OpenedSession opened("open");
  opened.set_fuzz(0.5);
  OpenedSession::write(0.125, "other.json");
  opened.session->editor.open(fs::absolute("other.json").string());
  REQUIRE(opened.comes_true([&] { return opened.fuzz() == 0.125; }));
  CHECK(opened.session->editor.document().origin->title == "other.json");
  opened.session->editor.undo();
  CHECK(opened.fuzz() == 0.5);
  CHECK(opened.session->editor.document().origin->title == "scene.json");
  opened.session->editor.open("no such file");
  REQUIRE(opened.comes_true([&] { return opened.session->messages.current().error; }));
  CHECK(opened.fuzz() == 0.5);
}

TEST_CASE("the file is read again when it changes; with edits the user is asked first") {
  OpenedSession opened("reload");
  OpenedSession::write(0.625);
  REQUIRE(opened.comes_true([&] { return opened.fuzz() == 0.625; }));
  opened.set_fuzz(0.5);
  Editor& editor = opened.session->editor;
  OpenedSession::write(0.75);
  REQUIRE(opened.comes_true([&] { return editor.offers_reload(); }));
  CHECK(opened.fuzz() == 0.5);
  editor.answer_about_file(false);
  CHECK(opened.fuzz() == 0.5);
  CHECK(std::get<Metal<>>(editor.document().origin->saved.materials[0].kind).fuzz == 0.75);
  OpenedSession::write(0.875);
  REQUIRE(opened.comes_true([&] { return editor.offers_reload(); }));
  editor.answer_about_file(true);
  CHECK(opened.fuzz() == 0.875);
  CHECK_FALSE(edited(editor.document()));
  editor.undo();
  CHECK(opened.fuzz() == 0.5);
  std::ofstream("scene.json") << "{";
  REQUIRE(opened.comes_true([&] { return opened.session->messages.current().error; }));
  CHECK(opened.fuzz() == 0.5);
}

TEST_CASE("edits that are not saved come back in the next session, and one undo goes back to the file") {
  OpenedSession opened("restore");
  opened.set_fuzz(0.5);
  opened.reopen();
  CHECK(opened.fuzz() == 0.5);
  CHECK(opened.session->messages.current().text.find("restored the edits of scene.json") == 0);
  opened.session->editor.undo();
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
  opened.session->flush_edits();
  opened.session.reset();
  OpenedSession::write(0.75);
  opened.open();
  Editor& editor = opened.session->editor;
  CHECK(opened.fuzz() == 0.5);
  REQUIRE(editor.offers_reload());
  editor.answer_about_file(true);
  CHECK(opened.fuzz() == 0.75);
  CHECK_FALSE(edited(editor.document()));
  editor.undo();
  CHECK(opened.fuzz() == 0.5);
}

TEST_CASE("a file that another program has left broken is told of until it is mended, and differs from what was read") {
  OpenedSession opened("broken");
  Editor& editor = opened.session->editor;
  CHECK_FALSE(file_differs(*editor.document().origin));
  std::ofstream("scene.json") << "{";
  REQUIRE(opened.comes_true([&] { return opened.session->messages.current().error; }));
  const std::string told = opened.session->messages.current().text;
  opened.set_fuzz(0.5);
  CHECK(opened.session->messages.current().text == told);
  CHECK(file_differs(*editor.document().origin));
  editor.save(editor.document().origin->file);  // as the user wished, after being asked
  CHECK_FALSE(file_differs(*editor.document().origin));
  opened.set_fuzz(0.625);
  CHECK_FALSE(opened.session->messages.current().error);
}

namespace {

/// A session over a scene with a texture of one pixel.
struct TexturedSession : OpenedSession {
  explicit TexturedSession(const std::string& name) : OpenedSession(name) {
    paint("map.png", 0.25f);
    write_textured("map.png");
    editor().open(fs::absolute("textured.json").string());
    REQUIRE(comes_true([&] { return editor().document().origin->title == "textured.json"; }));
  }
  Editor& editor() const { return session->editor; }
  static void paint(const std::string& file, float red) { write_png(file, {1, 1, {red, 0, 0}}, 0, ToneMap::srgb, {}); }
  static void write_textured(const std::string& map) {
    write_text("textured.json", R"({ "tyndall": 1, "image": { "width": 8, "height": 8 }, "background": [1, 1, 1],
      "render": { "spp": 1 }, "textures": { "map": { "type": "image", "file": ")" +
                                    map + R"(" } },
      "materials": { "land": { "type": "lambertian", "albedo": "map" } },
      "objects": [{ "type": "sphere", "center": [0, 0, -2], "radius": 1, "material": "land" }] })");
  }
  /// Of the texture that is shown.
  /// As the byte of a picture file.
  int red() const {
    const float light = std::get<Image>(editor().scene().textures[0].kind).pixels->rgb[0];
    return static_cast<int>(std::lround(255 * srgb_encode(light)));
  }
  bool complains() {
    return comes_true([&] { return session->messages.current().error; });
  }
  bool shows(int red_byte) {
    return comes_true([&] { return red() == red_byte && !session->messages.current().error; }) && finishes();
  }
};

}  // namespace

TEST_CASE("textures are read again when they are written, renamed over, or come back") {
  TexturedSession opened("watched_textures");
  REQUIRE(opened.shows(137));
  const std::uint64_t edit = opened.session->renderers.edit(Half::current);
  opened.paint("other.png", 0.5f);
  write_text("map.png", read_text("other.png"));  // in place
  REQUIRE(opened.shows(188));
  CHECK(opened.session->renderers.edit(Half::current) > edit);
  opened.paint("other.png", 1);
  fs::rename("other.png", "map.png");
  REQUIRE(opened.shows(255));
  fs::rename("map.png", "away.png");
  REQUIRE(opened.complains());
  CHECK(opened.session->messages.current().text.find("map.png") != std::string::npos);
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
  REQUIRE(opened.shows(137));
  Scene scene = opened.editor().scene();
  scene.camera.vfov = 30;
  opened.editor().edit(scene, 0);
  opened.paint("map.png", 0.5f);
  REQUIRE(opened.shows(188));
  CHECK_FALSE(opened.editor().offers_reload());
  CHECK(opened.editor().scene().camera.vfov == 30);
  opened.editor().undo();
  CHECK(opened.red() == 188);
  CHECK_FALSE(edited(opened.editor().document()));
  opened.editor().redo();
  CHECK(opened.editor().scene().camera.vfov == 30);
}

TEST_CASE("a scene that names a texture before it is there is read when it comes") {
  TexturedSession opened("texture_to_come");
  REQUIRE(opened.shows(137));
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

TEST_CASE(
    "a scene that was opened by a symbolic link is read again when its target is saved or the link leads elsewhere") {
  OpenedSession opened("link");
  fs::create_directory("in");
  OpenedSession::write(0.125, "in/a.json");
  OpenedSession::write(0.875, "in/b.json");
  fs::create_symlink("in/a.json", "link.json");
  opened.session->editor.open(fs::absolute("link.json").string());
  REQUIRE(opened.comes_true([&] { return opened.fuzz() == 0.125; }));
  OpenedSession::write(0.375, "in/a.json");
  REQUIRE(opened.comes_true([&] { return opened.fuzz() == 0.375; }));
  OpenedSession::write(0.625, "in/new.json");
  fs::rename("in/new.json", "in/a.json");
  REQUIRE(opened.comes_true([&] { return opened.fuzz() == 0.625; }));
  fs::create_symlink("in/b.json", "next.json");
  fs::rename("next.json", "link.json");
  REQUIRE(opened.comes_true([&] { return opened.fuzz() == 0.875; }));
  opened.set_fuzz(0.5);
  CHECK(opened.session->editor.save(opened.session->editor.document().origin->file));
  CHECK(fs::is_symlink("link.json"));
  CHECK(std::get<Metal<>>(load_scene("in/b.json").scene.materials[0].kind).fuzz == 0.5);
}

TEST_CASE("a scene with textures can be saved to other folders again and again") {
  OpenedSession opened("textures");
  fs::create_directories("in/deep");
  fs::copy_file(assets_folder() / "textures" / "planet.png", "in/map.png");
  std::ofstream("in/scene.json") << R"({ "tyndall": 1, "image": { "width": 8, "height": 8 },
    "textures": { "map": { "type": "image", "file": "./map.png" } },
    "materials": { "land": { "type": "lambertian", "albedo": "map" } },
    "objects": [{ "type": "sphere", "center": [0, 0, -2], "radius": 1, "material": "land" }] })";
  Editor& editor = opened.session->editor;
  editor.open("in/scene.json");
  REQUIRE(opened.comes_true(
      [&] { return editor.document().origin->title == "scene.json" && editor.scene().textures.size() == 1; }));
  const auto set_vfov = [&](double vfov) {
    Scene scene = editor.scene();
    scene.camera.vfov = vfov;
    editor.edit(scene, 0);
  };
  set_vfov(50);
  for (const char* file : {"copy.json", "copy.json", "in/deep/copy.json", "in/scene.json"}) {
    set_vfov(editor.scene().camera.vfov + 1);
    editor.save(file);
    CHECK_FALSE(edited(editor.document()));
    CHECK(load_scene(file).scene == editor.scene());
    set_vfov(editor.scene().camera.vfov + 1);
    opened.session->keep_edits();
    opened.session->flush_edits();
  }
  editor.undo();
  editor.undo();
  editor.save("in/deep/older.json");
  CHECK(load_scene("in/deep/older.json").scene.camera.vfov == editor.scene().camera.vfov);
  opened.session->snapshot();
  REQUIRE(opened.comes_true([&] { return fs::exists("older-001.png"); }));
  CHECK(load_scene("older-001.png").scene.textures.size() == 1);
}

TEST_CASE("the selection stays on its objects through undo, redo and a file that is read again") {
  OpenedSession opened("selection");
  Editor& editor = opened.session->editor;
  const auto with = [&](const std::vector<std::string>& names) {
    Scene scene = editor.scene();
    const Object ball = scene.objects[0];
    scene.objects.clear();
    for (const std::string& name : names) scene.objects.push_back({name, ball.kind, {}});
    return scene;
  };
  editor.edit(with({"a", "b", "c"}), 0);
  editor.select({{0}, {2}});
  editor.edit(with({"a", "a 2", "b", "c", "c 2"}), 0);  // duplicated
  editor.select({{1}, {4}});
  editor.undo();
  CHECK(editor.selection() == ObjectPaths{{0}, {2}});
  editor.select({{2}});
  editor.redo();
  CHECK(editor.selection() == ObjectPaths{{3}});
  editor.save("scene.json");
  std::ofstream("scene.json") << write_scene(with({"new", "a", "c"}));
  REQUIRE(opened.comes_true([&] { return editor.scene().objects.size() == 3; }));
  CHECK(editor.selection() == ObjectPaths{{2}});
}

TEST_CASE("saving is no edit, and is not read again as one") {
  OpenedSession opened("save");
  CHECK_FALSE(opened.session->editor.edited());
  opened.set_fuzz(0.5);
  CHECK(opened.session->editor.edited());
  REQUIRE(opened.finishes());
  const std::uint64_t edits = opened.session->renderers.edit(Half::current);
  opened.session->editor.save(opened.session->editor.document().origin->file);
  CHECK_FALSE(opened.session->editor.edited());
  const auto saved = opened.session->editor.document().origin;
  // The file was read again.
  REQUIRE(opened.comes_true([&] { return opened.session->editor.document().origin != saved; }));
  REQUIRE(opened.finishes());
  CHECK(opened.session->renderers.edit(Half::current) == edits);
  CHECK(std::get<Metal<>>(load_scene("scene.json").scene.materials[0].kind).fuzz == 0.5);
  opened.session->editor.save("no/such/folder/a.json");
  CHECK(opened.session->messages.current().error);
}

TEST_CASE("a snapshot holds the newest edit, also when it was not sent yet, and is finished when the window closes") {
  OpenedSession opened("snapshot");
  REQUIRE(opened.finishes());
  opened.set_fuzz(0.875);
  opened.session->snapshot();
  REQUIRE(opened.comes_true([&] { return fs::exists("scene-001.png"); }));
  CHECK(std::get<Metal<>>(load_scene("scene-001.png").scene.materials[0].kind).fuzz == 0.875);
  opened.session->snapshot();
  opened.session.reset();
  CHECK(fs::exists("scene-002.png"));
}

TEST_CASE("a picture of the window's size: rendered and in snapshots, while the scene keeps the file's") {
  OpenedSession opened("picture_size");
  REQUIRE(opened.finishes());
  opened.session->set_picture_size(PictureSize{12, 10});
  REQUIRE(opened.finishes());
  CHECK(opened.session->renderers.latest(Half::current)->width == 12);
  CHECK(opened.session->editor.scene().width == 8);
  CHECK_FALSE(edited(opened.session->editor.document()));
  opened.session->snapshot();
  REQUIRE(opened.comes_true([&] { return fs::exists("scene-001.png"); }));
  CHECK(load_scene("scene-001.png").scene.height == 10);
  opened.session->set_picture_size({});
  REQUIRE(opened.finishes());
  CHECK(opened.session->renderers.latest(Half::current)->width == 8);
}

TEST_CASE("the chart is exported, numbered; a folder that is gone is said") {
  OpenedSession opened("export");
  opened.session->export_chart();
  CHECK(opened.session->messages.current().text == "there is no curve yet");
  REQUIRE(opened.finishes());
  opened.session->shown(Half::current, opened.session->renderers.latest(Half::current));
  opened.session->export_chart();
  opened.session->export_chart();
  REQUIRE(opened.comes_true([&] { return fs::exists("scene-chart-002.svg"); }));
  CHECK(fs::exists("scene-chart-001.csv"));
  const fs::path folder = fs::current_path();
  fs::remove_all(folder);
  opened.session->export_chart();
  REQUIRE(opened.comes_true([&] { return opened.session->messages.current().error; }));
  CHECK(opened.session->messages.current().text.find("scene-chart-003.csv: cannot write") != std::string::npos);
  opened.session->messages.dismiss();
  opened.session->snapshot();
  REQUIRE(opened.comes_true([&] { return opened.session->messages.current().error; }));
  fs::create_directories(folder);
}

TEST_CASE("a damaged file of preferences that cannot be moved is not said to be elsewhere") {
  const fs::path config = scratch_folder() / "damaged_preferences", file = config / "tyndall" / "window.txt";
  fs::remove_all(config);
  fs::create_directories(config / "tyndall" / "window.txt.damaged" / "in the way");
  std::ofstream(file) << "no preferences\n";
  const char* before = std::getenv("XDG_CONFIG_HOME");
  const std::string kept = before ? before : "";
  setenv("XDG_CONFIG_HOME", config.c_str(), 1);
  {
    OpenedSession stays("damaged_stays");
    CHECK(stays.session->messages.current().text ==
          file.string() +
              " is damaged; the window begins with its defaults, and the file cannot be moved out of the way");
    CHECK(fs::exists(file));
    fs::remove_all(config / "tyndall" / "window.txt.damaged");
    OpenedSession goes("damaged_goes");
    CHECK(goes.session->messages.current().text ==
          file.string() + " is damaged; the window begins with its defaults, the file is now window.txt.damaged");
  }
  if (before)
    setenv("XDG_CONFIG_HOME", kept.c_str(), 1);
  else
    unsetenv("XDG_CONFIG_HOME");
}

}  // namespace tyndall::test::session_files_test
