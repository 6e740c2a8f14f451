#include "tests/app/window/opened_session.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>

using namespace tyndall;
using test::OpenedSession;
namespace fs = std::filesystem;

TEST_CASE("opening another scene can be undone, with where it came from") {
  OpenedSession opened("open");
  opened.set_fuzz(0.5);
  OpenedSession::write(0.125, "other.json");
  opened.session->editor().open(fs::absolute("other.json").string());
  REQUIRE(opened.comes_true([&] { return opened.fuzz() == 0.125; }));
  CHECK(opened.session->editor().document().origin->title == "other.json");
  opened.session->editor().undo();
  CHECK(opened.fuzz() == 0.5);
  CHECK(opened.session->editor().document().origin->title == "scene.json");
  opened.session->editor().open("no such file");
  REQUIRE(opened.comes_true([&] { return opened.session->messages().current().error; }));
  CHECK(opened.fuzz() == 0.5);
}

TEST_CASE("the file is read again when it changes; with edits the user is asked first") {
  OpenedSession opened("reload");
  OpenedSession::write(0.625);
  REQUIRE(opened.comes_true([&] { return opened.fuzz() == 0.625; }));
  opened.set_fuzz(0.5);
  Editor& editor = opened.session->editor();
  OpenedSession::write(0.75);
  REQUIRE(opened.comes_true([&] { return editor.asks_about_file(); }));
  CHECK(opened.fuzz() == 0.5);
  editor.answer_about_file(false);
  CHECK(opened.fuzz() == 0.5);
  CHECK(std::get<Metal<>>(editor.document().origin->saved.materials[0].kind).fuzz == 0.75);
  OpenedSession::write(0.875);
  REQUIRE(opened.comes_true([&] { return editor.asks_about_file(); }));
  editor.answer_about_file(true);
  CHECK(opened.fuzz() == 0.875);
  CHECK_FALSE(edited(editor.document()));
  editor.undo();
  CHECK(opened.fuzz() == 0.5);
  std::ofstream("scene.json") << "{";
  REQUIRE(opened.comes_true([&] { return opened.session->messages().current().error; }));
  CHECK(opened.fuzz() == 0.5);
}

TEST_CASE("edits that are not saved come back in the next session, and one undo goes back to the file") {
  OpenedSession opened("restore");
  opened.set_fuzz(0.5);
  opened.reopen();
  CHECK(opened.fuzz() == 0.5);
  CHECK(opened.session->messages().current().text.find("restored the edits of scene.json") == 0);
  opened.session->editor().undo();
  CHECK(opened.fuzz() == 0.25);
  opened.reopen();  // undone edits are none
  CHECK(opened.fuzz() == 0.25);
  opened.set_fuzz(0.75);
  opened.session->keep_edits();
  opened.session->discard_edits();
  opened.reopen();
  CHECK(opened.fuzz() == 0.25);
}

TEST_CASE("saving is no edit, and is not read again as one") {
  OpenedSession opened("save");
  opened.set_fuzz(0.5);
  REQUIRE(opened.finishes());
  const std::uint64_t edits = opened.session->renderers().edit(Half::current);
  opened.session->editor().save(opened.session->editor().document().origin->file);
  CHECK_FALSE(edited(opened.session->editor().document()));
  const auto saved = opened.session->editor().document().origin;
  // The file was read again.
  REQUIRE(opened.comes_true([&] { return opened.session->editor().document().origin != saved; }));
  REQUIRE(opened.finishes());
  CHECK(opened.session->renderers().edit(Half::current) == edits);
  CHECK(std::get<Metal<>>(load_scene("scene.json").scene.materials[0].kind).fuzz == 0.5);
  opened.session->editor().save("no/such/folder/a.json");
  CHECK(opened.session->messages().current().error);
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
  CHECK(opened.session->renderers().latest(Half::current)->width == 12);
  CHECK(opened.session->editor().scene().width == 8);
  CHECK_FALSE(edited(opened.session->editor().document()));
  opened.session->snapshot();
  REQUIRE(opened.comes_true([&] { return fs::exists("scene-001.png"); }));
  CHECK(load_scene("scene-001.png").scene.height == 10);
  opened.session->set_picture_size({});
  REQUIRE(opened.finishes());
  CHECK(opened.session->renderers().latest(Half::current)->width == 8);
}

TEST_CASE("the chart is exported, numbered; a folder that is gone is said") {
  OpenedSession opened("export");
  opened.session->export_chart();
  CHECK(opened.session->messages().current().text == "there is no curve yet");
  REQUIRE(opened.finishes());
  opened.session->shown(Half::current, opened.session->renderers().latest(Half::current));
  opened.session->export_chart();
  opened.session->export_chart();
  REQUIRE(opened.comes_true([&] { return fs::exists("scene-chart-002.svg"); }));
  CHECK(fs::exists("scene-chart-001.csv"));
  const fs::path folder = fs::current_path();
  fs::remove_all(folder);
  opened.session->export_chart();
  REQUIRE(opened.comes_true([&] { return opened.session->messages().current().error; }));
  CHECK(opened.session->messages().current().text.find("scene-chart-003.csv: cannot write") != std::string::npos);
  opened.session->messages().dismiss();
  opened.session->snapshot();
  REQUIRE(opened.comes_true([&] { return opened.session->messages().current().error; }));
  fs::create_directories(folder);
}
