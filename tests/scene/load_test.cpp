#include "core/scene/load.h"

#include "core/image/image_io.h"
#include "tests/scene/files.h"
#include "tests/support/paths.h"

#include <doctest/doctest.h>

#include <cstdlib>

namespace tyndall::test::load_test {
namespace fs = std::filesystem;

namespace {

const fs::path assets = assets_folder();
const fs::path scratch = scratch_folder() / "load_test";

fs::path write(const std::string& name, const std::string& text) {
  fs::create_directories(scratch);
  std::ofstream(scratch / name, std::ios::binary) << text;
  return scratch / name;
}

std::string complaint_about(const std::string& what) {
  try {
    load_scene(what);
    return "";
  } catch (const SceneError& error) {
    return error.what();
  }
}

}  // namespace

TEST_CASE("load_scene: built-in scenes by name") {
  ::setenv("TYNDALL_ASSETS", assets.c_str(), 1);
  const LoadedScene earth = load_scene("earth", {{"/camera/vfov", "30"}});
  CHECK(earth.name == "earth");
  CHECK(earth.source.empty());
  CHECK(earth.folder == assets / "scenes");
  CHECK(earth.scene.camera.vfov == 30);
  CHECK(earth.text == test::read_text(assets / "scenes" / "earth.json"));
  const auto scenes = built_in_scenes();
  CHECK(scenes.size() >= 18);
  CHECK(std::is_sorted(scenes.begin(), scenes.end(), [](const auto& a, const auto& b) { return a.name < b.name; }));
  const auto smoke =
      std::find_if(scenes.begin(), scenes.end(), [](const auto& s) { return s.name == "cornell-smoke"; });
  REQUIRE(smoke != scenes.end());
  CHECK(smoke->title == "Cornell smoke");
  CHECK(smoke->path == assets / "scenes" / "cornell-smoke.json");
  CHECK(complaint_about("cornel-smoke").ends_with("(did you mean \"cornell-smoke\"?)"));
}

TEST_CASE("load_scene: finds the assets that TYNDALL_ASSETS names, and does without any") {
  fs::create_directories(scratch / "assets" / "scenes");
  write("assets/scenes/mine.json", "// about mine\n{ \"tyndall\": 1 }");
  write("assets/scenes/broken.json", "// about broken\n{");
  ::setenv("TYNDALL_ASSETS", (scratch / "assets").c_str(), 1);
  const auto scenes = built_in_scenes();
  REQUIRE(scenes.size() == 2);
  CHECK(scenes[0].title == "about broken");
  CHECK(scenes[1].title == "about mine");
  CHECK(complaint_about("mine") == "");
  ::setenv("TYNDALL_ASSETS", (scratch / "nowhere").c_str(), 1);
  CHECK(built_in_scenes().empty());
  CHECK(complaint_about("mine").find("no built-in scenes were found") != std::string::npos);
  ::setenv("TYNDALL_ASSETS", assets.c_str(), 1);
}

TEST_CASE("load_scene: files, and textures beside them") {
  fs::create_directories(scratch / "textures");
  fs::copy_file(assets / "textures" / "planet.png", scratch / "textures" / "planet.png",
                fs::copy_options::overwrite_existing);
  const std::string text =
      R"({ "tyndall": 1, "textures": { "p": { "type": "image", "file": "textures/planet.png" } } })";
  const fs::path file = write("planet.json", text);
  const LoadedScene loaded = load_scene(file.string());
  CHECK(loaded.name == file.string());
  CHECK(loaded.source == file);
  CHECK(loaded.folder == scratch);
  CHECK(loaded.text == text);
  write("cover", "{ \"tyndall\": 1, \"name\": \"my own\" }");
  const fs::path before = fs::current_path();
  fs::current_path(scratch);
  CHECK(load_scene("planet.json").folder == ".");
  CHECK(load_scene("cover").scene.name == "Cover");
  CHECK(load_scene("./cover").scene.name == "my own");
  fs::current_path(before);
}

TEST_CASE("load_scene: what cannot be loaded is refused with a reason") {
  const std::string missing = (scratch / "none.json").string();
  CHECK(complaint_about(missing).starts_with(missing + ": found no such file, expected a scene file, an image"));
  CHECK(complaint_about(scratch.string()).starts_with(scratch.string() + ": found a folder, expected"));
  CHECK(complaint_about("").find("found no such file") != std::string::npos);
  CHECK(complaint_about((assets / "textures" / "planet.png").string())
            .ends_with("planet.png: found an image without a scene in it, expected a PNG or EXR that Tyndall wrote"));
  CHECK(complaint_about(write("short.png", "\x89PNG\r\n\x1a\n").string()).find("expected a") != std::string::npos);
  CHECK(complaint_about(write("empty.json", "").string()).find("/: found an empty file") != std::string::npos);
  CHECK(complaint_about("no\nfile\x1b").find("no\\nfile\\u001b: found no such file") == 0);
}

TEST_CASE("load_scene: the scene in an image that Tyndall wrote") {
  fs::create_directories(scratch);
  const std::string text = "{ \"tyndall\": 1, \"name\": \"snapshot\", \"render\": { \"spp\": 3 } }";
  write_png(scratch / "snapshot.png", {2, 1, {0, 0, 0, 1, 1, 1}}, 0, ToneMap::srgb, {text, ""});
  const LoadedScene loaded = load_scene((scratch / "snapshot.png").string(), {{"/render/spp", "4"}});
  CHECK(loaded.scene.name == "snapshot");
  CHECK(loaded.scene.render.spp == 4);
  CHECK(loaded.text == text);
  CHECK(loaded.source.empty());
}

TEST_CASE("move_textures: another folder finds the same files") {
  Scene scene;
  const auto pixels = std::make_shared<const Image::Pixels>(Image::Pixels{1, 1, {1, 2, 3}});
  scene.textures = {{"a", Image{"../textures/a.png", pixels}},
                    {"b", Image{"/somewhere/b.png", pixels}},
                    {"c", Image{"c.png", pixels}},
                    {"d", Checker<>()}};
  const Scene moved = move_textures(scene, scratch / "scenes", scratch / "out" / "deep");
  CHECK(std::get<Image>(moved.textures[0].kind).file == "../../textures/a.png");
  CHECK(std::get<Image>(moved.textures[1].kind).file == "/somewhere/b.png");
  CHECK(std::get<Image>(moved.textures[2].kind).file == "../../scenes/c.png");
  CHECK(move_textures(scene, scratch, scratch) == scene);
}

}  // namespace tyndall::test::load_test
