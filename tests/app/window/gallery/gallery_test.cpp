#include "app/window/gallery/gallery.h"
#include "tests/app/window/scenes.h"
#include "tests/support/news.h"
#include "tests/support/scratch.h"

#include <map>

namespace tyndall::test::gallery_test {
namespace fs = std::filesystem;

namespace {

std::string write_sphere(const fs::path& file, const std::string& red) {
  write_text(file, R"({ "tyndall": 1, "image": { "width": 64, "height": 20 }, "background": [0.5, 0.5, 0.5],
    "materials": { "ball": { "type": "lambertian", "albedo": [)" +
                       red + R"(, 0.2, 0.2] } },
    "objects": [{ "type": "sphere", "center": [0, 0, -2], "radius": 1, "material": "ball" }] })");
  return file.string();
}

/// What comes when these scenes are to be seen.
std::map<std::string, ScreenPicture> pictures_of(const fs::path& cache, const std::vector<std::string>& scenes) {
  News news;
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

}  // namespace

TEST_CASE("a thumbnail is rendered once and then comes from the cache, by what the scene's file holds") {
  const fs::path folder = scratch_folder("gallery_test"), cache = folder / "a" / "cache";
  const std::string scene = write_sphere(folder / "ball.json", "0.9");
  const auto now = [&] { return pictures_of(cache, {scene})[scene]; };
  const ScreenPicture first = now();
  CHECK(first.width == 128);
  CHECK(first.height == 40);
  REQUIRE(count_files(cache) == 1);
  CHECK(now().rgb == first.rgb);
  const fs::path file = fs::directory_iterator(cache)->path(), other = folder / "other.png";
  write_thumbnail(other, {2, 1, {10, 20, 30, 40, 50, 60}});
  fs::rename(other, file);
  CHECK(now().rgb == std::vector<std::uint8_t>{10, 20, 30, 40, 50, 60});  // whatever is in the cache is taken
  write_text(file, "damaged");                                            // is no error
  const ScreenPicture again = now();
  CHECK(again.rgb.size() == first.rgb.size());
  CHECK(read_thumbnail(file)->rgb == again.rgb);
  write_sphere(scene, "0.1");
  CHECK(now().rgb != first.rgb);
  CHECK(count_files(cache) == 2);
}

TEST_CASE("a scene that cannot be read has an empty picture; without a cache folder pictures come all the same") {
  const fs::path folder = scratch_folder("gallery_test");
  const std::string good = write_sphere(folder / "ball.json", "0.9"), bad = (folder / "bad.json").string();
  write_text(bad, "{ broken");
  write_text(folder / "file", "no folder");
  for (const fs::path& cache : {fs::path(), folder / "file" / "cache"}) {
    auto came = pictures_of(cache, {bad, good, "no such scene"});
    CHECK(came[bad].rgb.empty());
    CHECK(came["no such scene"].rgb.empty());
    CHECK(came[good].rgb.size() == 128 * 40 * 3);
  }
}

TEST_CASE("the key of a thumbnail changes with the scene's text and its textures' bytes") {
  const fs::path folder = scratch_folder("gallery_test");
  write_text(folder / "texture", "1");
  LoadedScene loaded;
  loaded.text = "{}";
  loaded.files = {folder / "scene.json", folder / "texture"};
  const std::string key = thumbnail_key(loaded);
  CHECK(key.size() == 16);
  CHECK(thumbnail_key(loaded) == key);
  write_text(folder / "texture", "2");
  CHECK(thumbnail_key(loaded) != key);
  loaded.files.pop_back();
  loaded.text = "{ }";
  CHECK(thumbnail_key(loaded) != key);
}

TEST_CASE("recent files: the newest first, each once, only those that are there; garbage in the list is no error") {
  const fs::path folder = scratch_folder("gallery_test"), list = folder / "state" / "recent.txt";
  const auto recent = [&] { return read_recent_files(list); };
  CHECK(recent().empty());
  std::vector<fs::path> files;
  for (int k = 0; k < 10; ++k) {
    files.push_back(folder / (std::to_string(k) + ".json"));
    write_text(files.back(), "{}");
    add_recent_file(list, files.back());
  }
  CHECK(recent().size() == max_recent_files);
  CHECK(recent()[0] == files[9]);
  add_recent_file(list, files[5]);
  add_recent_file(list, "showroom");  // a built-in scene takes no place
  CHECK(recent().size() == max_recent_files);
  CHECK(recent()[0] == files[5]);
  CHECK(recent()[1] == files[9]);
  fs::remove(files[9]);
  CHECK(recent()[1] == files[8]);
  write_text(list, "\x01\xff\n/no/such/file\nrelative.json\n" + files[3].string() + "\n");
  CHECK(recent() == std::vector<fs::path>{files[3]});
  CHECK_NOTHROW(add_recent_file(folder / "0.json" / "list", files[1]));
  CHECK_NOTHROW(add_recent_file({}, files[1]));
}

TEST_CASE("stored cameras: without a picture as many as there is room for, each once") {
  CameraSlots slots;
  for (int k = 0; k < 12; ++k) {
    Camera camera;
    camera.vfov = 20 + k;
    store_camera(slots, camera, nullptr, {});
  }
  CHECK(slots.size() == max_camera_slots);
  CHECK(slots.back().camera.vfov == 31);
  CHECK(slots.front().camera.vfov == 24);
  store_camera(slots, slots[2].camera, nullptr, {});
  CHECK(slots.size() == max_camera_slots);
  CHECK(slots.back().camera.vfov == 26);
}

TEST_CASE("the small picture of a camera: means of what is shown, in the picture's proportions") {
  Frame frame;
  frame.width = 400, frame.height = 200, frame.grid = {400, 200};
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 400; ++x) {
      const float grey = x < 200 ? static_cast<float>((x + y) % 2) : 0.0f;  // its mean is 0.5
      frame.rgba.insert(frame.rgba.end(), {grey, grey, grey, 1});
    }
  const ScreenPicture small = small_picture(frame, {});
  CHECK(small.width == 96);
  CHECK(small.height == 48);
  const auto& rgb = small.rgb;
  REQUIRE(rgb.size() == 96 * 48 * 3);
  CHECK(rgb[3 * (10 * 96 + 10)] == about(188, 0.05));
  CHECK(rgb[3 * (10 * 96 + 80)] == 0);
  frame.view = View::noise;
  CHECK(small_picture(frame, {}).rgb.empty());  // the picture itself is not there yet
  frame.beauty = frame.rgba;
  CHECK(small_picture(frame, {}).rgb == rgb);
}

}  // namespace tyndall::test::gallery_test
