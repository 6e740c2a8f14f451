#include "app/window/gallery/gallery.h"
#include "tests/support/news.h"
#include "tests/support/paths.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

#include <fstream>
#include <map>

namespace tyndall::test::gallery_test {

namespace fs = std::filesystem;

namespace {

void write_sphere(const fs::path& file, double red) {
  std::ofstream(file) << R"({ "tyndall": 1, "image": { "width": 64, "height": 20 }, "background": [0.5, 0.5, 0.5],
    "materials": { "ball": { "type": "lambertian", "albedo": [)"
                      << red << R"(, 0.2, 0.2] } },
    "objects": [{ "type": "sphere", "center": [0, 0, -2], "radius": 1, "material": "ball" }] })";
}

/// What comes when these scenes are to be seen.
std::map<std::string, ScreenPicture> pictures_of(const fs::path& cache, const std::vector<std::string>& scenes) {
  test::News news;
  std::map<std::string, ScreenPicture> came;
  const auto take = [&](const std::string& scene, const ScreenPicture& picture) { came[scene] = picture; };
  Thumbnails thumbnails(cache, take, [&] { news.tell(); });
  thumbnails.want(scenes);
  CHECK(news.wait_until([&] {
    thumbnails.collect();
    return came.size() == scenes.size();
  }));
  CHECK(thumbnails.idle());
  return came;
}

std::vector<fs::path> files_in(const fs::path& folder) {
  return {fs::directory_iterator(folder), fs::directory_iterator()};
}

}  // namespace

TEST_CASE("a thumbnail is rendered once and then comes from the cache, by what the scene's file holds") {
  const fs::path folder = scratch_folder("gallery_test"), cache = folder / "a" / "cache";
  const std::string scene = (folder / "ball.json").string();
  write_sphere(scene, 0.9);
  const ScreenPicture first = pictures_of(cache, {scene})[scene];
  CHECK(first.width == 128);
  CHECK(first.height == 40);
  REQUIRE(files_in(cache).size() == 1);
  const fs::path file = files_in(cache)[0];
  CHECK(pictures_of(cache, {scene})[scene].rgb == first.rgb);

  const fs::path other = folder / "other.png";  // whatever is in the cache is taken
  write_thumbnail(other, {2, 1, {10, 20, 30, 40, 50, 60}});
  fs::rename(other, file);
  CHECK(pictures_of(cache, {scene})[scene].rgb == std::vector<std::uint8_t>{10, 20, 30, 40, 50, 60});

  std::ofstream(file) << "damaged";  // is no error
  const ScreenPicture again = pictures_of(cache, {scene})[scene];
  CHECK(again.rgb.size() == first.rgb.size());
  CHECK(read_thumbnail(file)->rgb == again.rgb);

  write_sphere(scene, 0.1);
  CHECK(pictures_of(cache, {scene})[scene].rgb != first.rgb);
  CHECK(files_in(cache).size() == 2);
}

TEST_CASE("a scene that cannot be read has an empty picture; without a cache folder pictures come all the same") {
  const fs::path folder = scratch_folder("gallery_test");
  const std::string good = (folder / "ball.json").string(), bad = (folder / "bad.json").string();
  write_sphere(good, 0.9);
  std::ofstream(bad) << "{ broken";
  std::ofstream(folder / "file") << "no folder";
  for (const fs::path& cache : {fs::path(), folder / "file" / "cache"}) {
    auto came = pictures_of(cache, {bad, good, "no such scene"});
    CHECK(came[bad].rgb.empty());
    CHECK(came["no such scene"].rgb.empty());
    CHECK(came[good].rgb.size() == 128 * 40 * 3);
  }
}

TEST_CASE("the key of a thumbnail changes with the scene's text and its textures' bytes") {
  const fs::path folder = scratch_folder("gallery_test");
  std::ofstream(folder / "texture") << "1";
  LoadedScene loaded;
  loaded.text = "{}";
  loaded.files = {folder / "scene.json", folder / "texture"};
  const std::string key = thumbnail_key(loaded);
  CHECK(key.size() == 16);
  CHECK(thumbnail_key(loaded) == key);
  std::ofstream(folder / "texture") << "2";
  CHECK(thumbnail_key(loaded) != key);
  loaded.files.pop_back();
  loaded.text = "{ }";
  CHECK(thumbnail_key(loaded) != key);
}

TEST_CASE("recent files: the newest first, each once, only those that are there; garbage in the list is no error") {
  const fs::path folder = scratch_folder("gallery_test"), list = folder / "state" / "recent.txt";
  CHECK(read_recent_files(list).empty());
  std::vector<fs::path> files;
  for (int k = 0; k < 10; ++k) {
    files.push_back(folder / (std::to_string(k) + ".json"));
    std::ofstream(files.back()) << "{}";
    add_recent_file(list, files.back());
  }
  CHECK(read_recent_files(list).size() == max_recent_files);
  CHECK(read_recent_files(list)[0] == files[9]);
  add_recent_file(list, files[5]);
  CHECK(read_recent_files(list)[0] == files[5]);
  CHECK(read_recent_files(list)[1] == files[9]);
  CHECK(read_recent_files(list).size() == max_recent_files);
  add_recent_file(list, "showroom");  // a built-in scene takes no place
  CHECK(read_recent_files(list).size() == max_recent_files);
  fs::remove(files[9]);
  CHECK(read_recent_files(list)[1] == files[8]);
  std::ofstream(list) << "\x01\xff\n/no/such/file\nrelative.json\n" << files[3].string() << "\n";
  CHECK(read_recent_files(list) == std::vector<fs::path>{files[3]});
  CHECK_NOTHROW(add_recent_file(folder / "0.json" / "list", files[1]));
  CHECK_NOTHROW(add_recent_file({}, files[1]));
}

}  // namespace tyndall::test::gallery_test
