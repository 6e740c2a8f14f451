#include "core/image/whole_file.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

#include <sys/file.h>
#include <sys/stat.h>
#include <fcntl.h>
#include <span>
#include <unistd.h>

namespace tyndall::test::whole_file_test {
namespace fs = std::filesystem;

namespace {

void put(WholeFile& file, const std::string& text) { file.write(std::as_bytes(std::span(text))); }

void save(const fs::path& file, const std::string& text) {
  WholeFile out(file);
  put(out, text);
  out.commit();
}

unsigned mode_of(const fs::path& file) {
  struct stat status {};
  REQUIRE(stat(file.c_str(), &status) == 0);
  return status.st_mode & 07777u;
}

std::string refusal(const fs::path& file) {
  try {
    save(file, "text");
  } catch (const ImageFileError& error) {
    return std::string(error.what()).substr(file.string().size());
  }
  return "none";
}

}  // namespace

TEST_CASE(
    "whole file: names of up to 255 bytes are written, also in letters of several bytes; longer ones are refused") {
  const fs::path folder = scratch_folder("whole_names");
  std::string two_bytes_each = "\xc3\xa9";
  while (two_bytes_each.size() < 254) two_bytes_each += "\xc3\xa9";
  for (const std::string& name :
       {std::string(229, 'a'), std::string(249, 'b'), std::string(255, 'c'), two_bytes_each}) {
    save(folder / name, name);
    CHECK(read_text(folder / name) == name);
  }
  CHECK(count_files(folder) == 4);
  CHECK_THROWS_AS(WholeFile(folder / std::string(256, 'd')), ImageFileError);
}

TEST_CASE("whole file: two writers of one file at a time do not mix, and the last one wins") {
  const fs::path folder = scratch_folder("whole_two"), file = folder / "a";
  const std::string old_name = "a.tmp-" + std::to_string(getpid());
  write_text(folder / old_name, "of another machine whose process has the same number");
  WholeFile first(file), second(file);
  CHECK(count_files(folder) == 3);
  put(first, "first"), put(second, "second");
  first.commit();
  CHECK(read_text(file) == "first");
  put(second, " one");
  second.commit();
  CHECK(read_text(file) == "second one");
  CHECK(fs::exists(folder / old_name));
}

TEST_CASE("whole file: the next writer removes what dead writers left, and nothing that lives") {
  const fs::path folder = scratch_folder("whole_dead"), file = folder / "a.exr";
  const std::string dead = "a.exr.tmp-0123456789abcdef", living = "a.exr.tmp-fedcba9876543210";
  const std::vector<std::string> others = {"a.exr.tmp-0123456789abcdeg", "a.exr.tmp-0123456789abcde",
                                           "b.exr.tmp-0123456789abcdef", "a.exr.tmp-0123456789abcdef.exr"};
  write_text(folder / dead, "dead"), write_text(folder / living, "living");
  for (const std::string& other : others) write_text(folder / other, "other");
  const int lock = open((folder / living).c_str(), O_RDWR);
  REQUIRE(flock(lock, LOCK_EX | LOCK_NB) == 0);
  { const WholeFile given_up(file); }
  CHECK_FALSE(fs::exists(folder / dead));
  CHECK(fs::exists(folder / living));
  for (const std::string& other : others) CHECK(fs::exists(folder / other));
  close(lock);
  save(file, "new");
  CHECK_FALSE(fs::exists(folder / living));
  CHECK(count_files(folder) == 1 + others.size());
}

TEST_CASE("whole file: the mode of what is replaced is kept, and a private file is private while it is written") {
  const fs::path folder = scratch_folder("whole_mode");
  const mode_t mask = umask(022);
  save(folder / "new", "new");
  CHECK(mode_of(folder / "new") == 0644);
  for (const unsigned mode : {0600u, 0640u, 0444u, 0755u}) {
    const fs::path file = folder / "kept";
    write_text(file, "old");
    REQUIRE(chmod(file.c_str(), mode) == 0);
    {
      WholeFile out(file);
      put(out, "new");
      for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().filename().string().find(".tmp-") != std::string::npos)
          CHECK((mode_of(entry.path()) & 077u) == 0);
      out.commit();
    }
    CHECK(mode_of(file) == mode);
    CHECK(read_text(file) == "new");
    fs::remove(file);
  }
  umask(mask);
}

TEST_CASE("whole file: the owner of what is replaced is kept where that is permitted") {
  if (geteuid() != 0) return;  // only root may give files away
  const fs::path file = scratch_folder("whole_owner") / "a";
  write_text(file, "old");
  REQUIRE(chown(file.c_str(), 12345, 23456) == 0);
  save(file, "new");
  struct stat status {};
  REQUIRE(stat(file.c_str(), &status) == 0);
  CHECK(status.st_uid == 12345);
  CHECK(status.st_gid == 23456);
}

TEST_CASE("whole file: what symbolic links point to is replaced; circles of links are refused") {
  const fs::path folder = scratch_folder("whole_links");
  fs::create_directory(folder / "real");
  write_text(folder / "real" / "file", "old");
  fs::create_symlink("real/file", folder / "second");
  fs::create_symlink("second", folder / "first");
  save(folder / "first", "new");
  CHECK(fs::is_symlink(folder / "first"));
  CHECK(fs::is_symlink(folder / "second"));
  CHECK(read_text(folder / "real" / "file") == "new");
  fs::create_symlink("b", folder / "a");
  fs::create_symlink("a", folder / "b");
  CHECK(refusal(folder / "a") == ": cannot write: Too many levels of symbolic links");
  CHECK(fs::is_symlink(folder / "a"));
  CHECK(refusal(folder / "real" / "") == ": cannot write: Is a directory");
  CHECK(count_files(folder) == 5);
  CHECK(count_files(folder / "real") == 1);
}

TEST_CASE("whole file: long files, and places written again") {
  const fs::path file = scratch_folder("whole_long") / "a";
  const std::string piece(700001, 'x');
  {
    WholeFile out(file);
    for (int i = 0; i < 5; ++i) put(out, piece);
    CHECK(out.position() == 5 * piece.size());
    out.seek(3);
    put(out, "yyy");
    out.seek(5 * piece.size());
    put(out, "end");
    out.commit();
  }
  std::string expected = piece + piece + piece + piece + piece + "end";
  expected.replace(3, 3, "yyy");
  CHECK(read_text(file) == expected);
}

TEST_CASE("whole file: what cannot be replaced is found beforehand, with the reason, and devices take bytes") {
  const fs::path folder = scratch_folder("whole_place");
  write_text(folder / "a", "old");
  CHECK(find_place(folder / "a").method == WriteMethod::replace);
  CHECK(find_place(folder / "none").method == WriteMethod::replace);
  CHECK_FALSE(find_place(folder / "none").exists);
  CHECK(find_place("-").method == WriteMethod::stream);
  for (const char* file : {"/dev/null", "/dev/fd/0"}) {
    if (!fs::exists(file)) continue;
    CAPTURE(file);
    if (file == std::string("/dev/null")) CHECK(find_place(file).method == WriteMethod::stream);
    CHECK(is_stream(file));
  }
  fs::create_symlink("/dev/null", folder / "nowhere");
  CHECK(find_place(folder / "nowhere").method == WriteMethod::stream);
  save(folder / "nowhere", "text");
  CHECK(fs::is_symlink(folder / "nowhere"));
  CHECK(fs::is_character_file("/dev/null"));
  CHECK_THROWS_AS(find_place(folder), ImageFileError);
  CHECK(beside("x/a.b.png", "new") == "x/a.b.new.png");
}

TEST_CASE("whole file: a file of a folder that takes no new ones is written into, and cut or made longer") {
  if (geteuid() == 0) return;  // permissions do not apply; tests/commands/test_outputs_slow.py tries it as another user
  const fs::path folder = scratch_folder("whole_closed"), file = folder / "a";
  for (const std::string& old : {std::string(200'000, 'x'), std::string("x"), std::string()}) {
    write_text(file, old);
    REQUIRE(chmod(folder.c_str(), 0555) == 0);
    {
      WholeFile out(file);
      CHECK(out.place().method == WriteMethod::in_place);
      CHECK(out.place().folder_problem == "Permission denied");
      put(out, "new bytes");
      CHECK(read_text(file) == old);
      out.commit();
    }
    CHECK(read_text(file) == "new bytes");
    REQUIRE(chmod(folder.c_str(), 0755) == 0);
  }
  CHECK(count_files(folder) == 1);
}

}  // namespace tyndall::test::whole_file_test
