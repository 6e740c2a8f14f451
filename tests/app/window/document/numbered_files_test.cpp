#include "app/window/document/numbered_files.h"

#include "core/base/error.h"
#include "tests/support/paths.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <semaphore>

namespace tyndall::test::numbered_files_test {
namespace fs = std::filesystem;

namespace {

fs::path scratch(const std::string& name) {
  const fs::path folder = scratch_folder() / ("numbered_" + name);
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

}  // namespace

TEST_CASE("numbered names: never one that exists, with any of the endings") {
  const fs::path folder = scratch("names");
  CHECK(numbered_base(folder, "a", 1, {".png", ".exr"}) == folder / "a-001");
  std::ofstream(folder / "a-001.png") << "";
  std::ofstream(folder / "a-002.exr") << "";
  fs::create_symlink("nowhere", folder / "a-003.png");
  CHECK(numbered_base(folder, "a", 1, {".png", ".exr"}) == folder / "a-004");
  CHECK(number_of(numbered_base(folder, "a", 7, {".png", ".exr"})) == 7);
}

TEST_CASE("no number is given twice, and what was written, or why not, is told") {
  const fs::path before = fs::current_path();
  fs::current_path(scratch("work"));
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
  fs::current_path(scratch("raced"));
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

}  // namespace tyndall::test::numbered_files_test
