#include "app/window/document/numbered_files.h"

#include "app/window/document/document.h"
#include "core/base/error.h"
#include "core/image/image_io.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <semaphore>
#include <string>

namespace tyndall::test::numbered_files_test {
namespace fs = std::filesystem;

TEST_CASE("numbered names: never one that exists, with any of the endings") {
  const fs::path folder = scratch_folder("numbered_names");
  CHECK(numbered_base(folder, "a", 1, {".png", ".exr"}) == folder / "a-001");
  std::ofstream(folder / "a-001.png") << "";
  std::ofstream(folder / "a-002.exr") << "";
  fs::create_symlink("nowhere", folder / "a-003.png");
  CHECK(numbered_base(folder, "a", 1, {".png", ".exr"}) == folder / "a-004");
  CHECK(number_of(numbered_base(folder, "a", 7, {".png", ".exr"})) == 7);
}

TEST_CASE("no number is given twice, and what was written, or why not, is told") {
  const fs::path before = fs::current_path();
  fs::current_path(scratch_folder("numbered_work"));
  std::counting_semaphore<> done(0);
  MessageLine messages(nullptr);
  JobQueue jobs([&] { done.release(); });
  NumberedFiles files({".txt"}, jobs, messages, nullptr);
  const fs::path first = files.next_base("a"), second = files.next_base("a");
  CHECK(first.filename() == "a-001");
  CHECK(second.filename() == "a-002");
  files.write(first, [](const fs::path&) { return std::string("written"); });
  done.acquire();
  CHECK(jobs.collect());
  CHECK_FALSE(jobs.collect());
  CHECK(messages.current().text == "written");
  CHECK_FALSE(messages.current().error);
  files.write(second, [](const fs::path&) -> std::string { throw IoError("no room"); });
  done.acquire();
  jobs.collect();
  CHECK(messages.current().text == "no room");
  CHECK(messages.current().error);
  fs::current_path(before);
}

TEST_CASE("messages are one line") {
  MessageLine messages(nullptr);
  messages.say("opened a\nb\xff.json");
  CHECK(messages.current().text == "opened a\\nb\\xff.json");
}

TEST_CASE("no file is overwritten that another window or program has written since the number was given") {
  const fs::path before = fs::current_path();
  fs::current_path(scratch_folder("numbered_raced"));
  std::counting_semaphore<> done(0);
  MessageLine messages(nullptr);
  JobQueue jobs([&] { done.release(); });
  NumberedFiles first({".txt", ".more"}, jobs, messages, nullptr), second({".txt", ".more"}, jobs, messages, nullptr);
  const auto write = [](const std::string& text) {
    return [text](const fs::path& base) {
      std::ofstream(base.string() + ".txt") << text;
      return base.filename().string();
    };
  };
  const fs::path one = first.next_base("a"), two = second.next_base("a");
  CHECK(one == two);
  first.write(one, write("first"));
  second.write(two, write("second"));
  done.acquire(), done.acquire();
  jobs.collect();
  CHECK(messages.current().text == "a-002");
  CHECK(fs::file_size("a-001.txt") == 5);
  CHECK(fs::file_size("a-002.txt") == 6);
  std::ofstream("a-003.more") << "of another program";
  CHECK(second.next_base("a").filename() == "a-004");
  fs::current_path(before);
}

TEST_CASE("a snapshot opens again as the scene that made it") {
  const fs::path folder = scratch_folder("snapshot");
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
  int requested = 0;
  const auto yes = [] { return true; };
  const auto no = [] { return false; };
  const auto late = [&] {
    Film film = make_film(2, 2, {0, 0, 2, 2}, 0, 1);
    for (FilmPixel& pixel : film.pixels) pixel.taken = ++requested > 8 ? 1 : 0;
    return film;
  };
  CHECK(wait_for_film(late, yes, yes).pixels.size() == 4);
  CHECK(wait_for_film(late, no, yes).pixels.empty());
  requested = 0;
  CHECK(wait_for_film(late, yes, no).pixels.empty());
}

}  // namespace tyndall::test::numbered_files_test
