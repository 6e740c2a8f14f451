#include "app/files/watch.h"

#include "tests/support/news.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

#include <filesystem>

using namespace tyndall;
namespace fs = std::filesystem;

TEST_CASE("a watched file tells of writing and of renaming over it, not of its neighbours") {
  const fs::path folder = scratch_folder("watched");
  write_text(folder / "a.json", "1");
  test::News news;
  const FileWatch watch(folder / "a.json", [&] { news.tell(); });
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
  CHECK_NOTHROW(FileWatch("/no/such/folder/a.json", [] {}));
}
