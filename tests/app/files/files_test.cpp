#include "app/files/watch.h"
#include "app/window/document/job_queue.h"
#include "app/window/document/open_document.h"
#include "app/window/document/snapshot.h"
#include "app/window/system/ui_log.h"

#include "core/image/image_io.h"
#include "tests/support/news.h"
#include "tests/support/paths.h"

#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

using namespace tyndall;
namespace fs = std::filesystem;

namespace {

fs::path scratch(const std::string& name) {
  const fs::path folder = scratch_folder() / ("window_" + name);
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

void write(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }

std::string read(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("comments are found, slashes in strings are none") {
  CHECK(has_comments("{ \"a\": 1 } // one"));
  CHECK(has_comments("/* one */ {}"));
  CHECK_FALSE(has_comments("{ \"file\": \"a/b//c\", \"x\": \"\\\"/\" }"));
  CHECK_FALSE(has_comments("{}"));
}

TEST_CASE("a saved scene reads back equal, from another folder too") {
  const fs::path folder = scratch("save");
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

TEST_CASE("a snapshot opens again as the scene that made it") {
  const fs::path folder = scratch("snapshot");
  Document document = document_of(load_scene("simple-light"));
  document.scene.width = 16;
  document.scene.height = 8;
  document.scene.camera.vfov = 33;
  Film film = make_film(16, 8, {0, 0, 16, 8}, 0, 4);
  for (FilmPixel& pixel : film.pixels) {
    add_sample(pixel, 0, {1, 1, 1}, 0.25);
    pixel.taken = 1;
  }
  const std::string text = write_snapshot({document, folder / "light-001", "scalar", 1}, film);
  CHECK(text.find("light-001.png") != std::string::npos);
  for (const char* name : {"light-001.png", "light-001.exr"}) {
    if (std::string(name).ends_with("exr") && !has_openexr()) continue;
    const LoadedScene again = load_scene((folder / name).string());
    CHECK(again.scene.camera == document.scene.camera);
    CHECK(again.scene.objects == document.scene.objects);
    CHECK(again.source.empty());
  }
}

TEST_CASE("a film is waited for, but not when the picture changed or the window closes") {
  int asked = 0;
  const auto yes = [] { return true; };
  const auto no = [] { return false; };
  const auto late = [&] {
    Film film = make_film(2, 2, {0, 0, 2, 2}, 0, 1);
    for (FilmPixel& pixel : film.pixels) pixel.taken = ++asked > 8 ? 1 : 0;
    return film;
  };
  CHECK(wait_for_film(late, yes, yes).pixels.size() == 4);
  CHECK(wait_for_film(late, no, yes).pixels.empty());
  asked = 0;
  CHECK(wait_for_film(late, yes, no).pixels.empty());
}

TEST_CASE("a watched file tells of writing and of renaming over it, not of its neighbours") {
  const fs::path folder = scratch("watch");
  write(folder / "a.json", "1");
  test::News news;
  const FileWatch watch(folder / "a.json", [&] { news.tell(); });
  for (int k = 0; k < 100; ++k) write(folder / "b.json", "2");
  CHECK(news.told() == 0);
  write(folder / "a.json", "3");
  CHECK(news.wait_until([&] { return news.told() > 0; }));
  CHECK(news.told() == 1);  // what happens in the folder is told in order: none was for the neighbour
  fs::rename(folder / "b.json", folder / "a.json");
  CHECK(news.wait_until([&] { return news.told() > 1; }));
  CHECK(news.told() == 2);
}

TEST_CASE("a folder that is not there is watched without harm") {
  CHECK_NOTHROW(FileWatch("/no/such/folder/a.json", [] {}));
}

TEST_CASE("jobs run in order elsewhere, results here, and none is lost at the end") {
  std::vector<int> order;
  std::atomic<int> ran = 0;
  test::News news;
  {
    JobQueue jobs([&] { news.tell(); });
    CHECK(jobs.idle());
    for (int k = 0; k < 3; ++k)
      jobs.run([&, k]() -> JobQueue::Result {
        ++ran;
        return [&, k] { order.push_back(k); };
      });
    CHECK(news.wait_until([&] { return news.told() == 3; }));
    CHECK(order.empty());
    CHECK_FALSE(jobs.idle());
    jobs.collect();
    CHECK(jobs.idle());
    CHECK(order == std::vector<int>{0, 1, 2});
    for (int k = 0; k < 3; ++k)
      jobs.run([&]() -> JobQueue::Result {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));  // the queue goes before
        ++ran;
        return {};
      });
  }
  CHECK(ran == 6);
}

TEST_CASE("the log says what changed, and at the end how long things took") {
  const fs::path file = scratch("log") / "ui.log";
  {
    UiLog log(file);
    for (int drawing = 0; drawing < 3; ++drawing) {
      log.widget("gold.fuzz", {1, 2, 3, 4}, drawing < 2 ? "0.1" : "0.2");
      if (drawing == 0) log.widget("a name", {0, 0, 1, 1}, "x");
      log.end_of_widgets();
    }
    log.submitted(1, 10);
    log.submitted(2, 10.5);
    Frame frame;
    frame.edit = 1;
    frame.step = 8;
    frame.first_picture_ms = 15;
    log.shown(frame, 10.02);
    frame.step = 1;
    frame.spp = 1;
    log.shown(frame, 10.05);
    frame.edit = 2;
    log.shown(frame, 10.6);
    log.drawn(0.002, true);
    Mouse mouse;
    mouse.x = mouse.y = -3e38f;
    log.mouse(mouse);
    mouse.x = 12, mouse.y = 34, mouse.down[0] = true, mouse.typing = true;
    log.mouse(mouse);
    mouse.down[0] = false, mouse.wheel = -1;
    log.mouse(mouse);
    for (int k = 0; k < 2; ++k) log.rest();
    log.line("key 82");
    log.rest();
  }
  CHECK(read(file) ==
        "widget gold.fuzz 1 2 3 4 0.1\nwidget a_name 0 0 1 1 x\ngone a_name\nwidget gold.fuzz 1 2 3 4 0.2\n"
        "submit 1\nsubmit 2\nframe 1 0 8 20.0 15.0\nframe 1 1 1 50.0 15.0\nframe 2 1 1 100.0 15.0\ndrawn 2.00 1\n"
        "mouse none\nbuttons 0 0 0\nkeyboard shortcuts\nmouse 12 34\nbuttons 1 0 0\nkeyboard control\n"
        "buttons 0 0 0\nwheel -1\nrest\nkey 82\nrest\n"
        "latency n 2 p50 20.0 p95 100.0 p99 100.0 max 100.0 ms\n"
        "cpu picture n 1 p50 2.0 p95 2.0 p99 2.0 max 2.0 ms\ncpu plain n 0 p50 0.0 p95 0.0 p99 0.0 max 0.0 ms\n");
  CHECK_THROWS_AS(UiLog("/no/such/folder/log"), std::exception);
}
