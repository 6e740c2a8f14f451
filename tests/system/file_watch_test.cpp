#include "core/system/file_watch.h"

#include "tests/support/news.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tyndall::test::file_watch_test {
namespace fs = std::filesystem;

TEST_CASE("a watched file tells of writing and of renaming over it, not of its neighbours") {
  const fs::path folder = scratch_folder("watched");
  write_text(folder / "a.json", "1");
  test::News news;
  const FileWatch watch({folder / "a.json"}, [&] { news.tell(); });
  for (int k = 0; k < 100; ++k) write_text(folder / "b.json", "2");
  CHECK(news.told() == 0);
  write_text(folder / "a.json", "3");
  CHECK(news.wait_until([&] { return news.told() > 0; }));
  CHECK(news.told() == 1);  // what happens in the folder is told in order: none was for the neighbour
  fs::rename(folder / "b.json", folder / "a.json");
  CHECK(news.wait_until([&] { return news.told() > 1; }));
  CHECK(news.told() == 2);
}

TEST_CASE("a folder that is not there is watched without harm") {
  CHECK_NOTHROW(FileWatch({"/no/such/folder/a.json"}, [] {}));
}

namespace {

/// A folder, and files in it that are watched.
class Watched {
 public:
  Watched(const char* name, const std::vector<std::string>& files) : folder(scratch_folder(name)), files_(files) {}
  void begin() {
    std::vector<fs::path> paths;
    for (const std::string& file : files_) paths.push_back(folder / file);
    watch_.emplace(paths, [this] { news_.tell(); });
  }
  /// Whether something has been told of since this was asked last.
  bool told() {
    const bool came = news_.wait_until([&] { return news_.told() > seen_; });
    seen_ = news_.told();
    return came;
  }
  bool told_nothing() const { return news_.told() == seen_; }

  fs::path folder;

 private:
  std::vector<std::string> files_;
  test::News news_;
  int seen_ = 0;
  std::optional<FileWatch> watch_;
};

}  // namespace

TEST_CASE(
    "a file behind symbolic links tells of being written and renamed over, and of each link that leads elsewhere") {
  Watched watched("watched_links", {"open/scene.json"});
  const fs::path& folder = watched.folder;
  for (const char* name : {"v1", "v2"}) fs::create_directory(folder / name), write_text(folder / name / "a.json", name);
  write_text(folder / "b.json", "b");
  fs::create_directory_symlink("v1", folder / "current");
  fs::create_directory(folder / "open");
  fs::create_symlink("../current/a.json", folder / "open" / "scene.json");
  watched.begin();
  write_text(folder / "v1" / "a.json", "in place");
  CHECK(watched.told());
  write_text(folder / "v1" / "new", "renamed");
  CHECK(watched.told_nothing());
  fs::rename(folder / "v1" / "new", folder / "v1" / "a.json");
  CHECK(watched.told());
  fs::create_directory_symlink(folder / "v2", folder / "next");  // an absolute one
  fs::rename(folder / "next", folder / "current");
  CHECK(watched.told());
  write_text(folder / "v2" / "a.json", "where the link leads now");
  CHECK(watched.told());
  fs::remove(folder / "open" / "scene.json");
  CHECK(watched.told());
  fs::create_symlink(folder / "b.json", folder / "open" / "scene.json");
  CHECK(watched.told());
  write_text(folder / "b.json", "behind the other link");
  CHECK(watched.told());
}

TEST_CASE("files that are removed are told of, and that they come back, by themselves or with their folder") {
  Watched watched("watched_gone", {"a.png", "in/b.png"});
  const fs::path& folder = watched.folder;
  write_text(folder / "a.png", "1");
  watched.begin();
  fs::remove(folder / "a.png");
  CHECK(watched.told());
  write_text(folder / "a.png", "2");
  CHECK(watched.told());
  fs::rename(folder / "a.png", folder / "away.png");
  CHECK(watched.told());
  fs::create_hard_link(folder / "away.png", folder / "a.png");
  CHECK(watched.told());
  fs::create_directory(folder / "in");  // was never there
  write_text(folder / "in" / "b.png", "3");
  CHECK(watched.told());
  fs::remove_all(folder / "in");
  CHECK(watched.told());
  fs::create_directory(folder / "elsewhere");
  write_text(folder / "elsewhere" / "b.png", "4");
  fs::rename(folder / "elsewhere", folder / "in");
  CHECK(watched.told());
}

TEST_CASE("links that lead round in a circle are watched without harm, and told of when one of them is mended") {
  Watched watched("watched_circle", {"a.json"});
  fs::create_symlink("b.json", watched.folder / "a.json");
  fs::create_symlink("a.json", watched.folder / "b.json");
  watched.begin();
  fs::remove(watched.folder / "b.json");
  write_text(watched.folder / "b.json", "an end");
  CHECK(watched.told());
}

TEST_CASE("a file that is saved twice within a second is told of twice, also where its size stays") {
  Watched watched("watched_twice", {"a.json"});
  write_text(watched.folder / "a.json", "0");
  watched.begin();
  for (const char* text : {"1", "2"}) {
    write_text(watched.folder / "a.json", text);
    CHECK(watched.told());
  }
}

}  // namespace tyndall::test::file_watch_test
