#include "app/window/timeline/timeline.h"
#include "app/window/variations/strip.h"
#include "core/scene/frames.h"
#include "tests/app/window/driver.h"
#include "tests/support/news.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace tyndall::test::window_rows_test {

TEST_CASE("the window: a slider's value goes to the renderer, once, and so does its undo") {
  Driver driver("slider");
  driver.click("gold.fuzz", 0.75);
  CHECK(driver.submits() == 2);
  CHECK(driver.value("gold.fuzz") != "0.2");
  driver.undo();
  CHECK(driver.value("gold.fuzz") == "0.2");
  CHECK(driver.submits() == 3);
}

TEST_CASE("the window: a value is asked for from its row, before anything else is drawn with it") {
  Driver driver("row_asks");
  driver.click("picture", 0.5, 0.45);
  std::ifstream log("log");
  log.seekg(0, std::ios::end);
  driver.click("Ball.radius", 0.75);
  std::string line;
  while (std::getline(log, line) && !line.starts_with("submit 2")) CHECK_FALSE(line.starts_with("widget handle."));
  while (std::getline(log, line) && !line.starts_with("widget handle.")) {
  }
  CHECK(log.good());
}

/// Vary or Key in the menu of a row. Does not wait until small pictures are finished.
void choose(Driver& driver, const std::string& row, const std::string& what) {
  driver.push(row, 0.9, 0.5, 1);
  driver.push(row + "." + what);
}

TEST_CASE("the window: small pictures of all values of a row, taken over by a click and by arrow keys") {
  Driver driver("vary");
  const auto has_fuzz = [&](const char* value) { driver.await_value("gold.fuzz", value); };
  choose(driver, "gold.fuzz", "vary");
  CHECK(driver.has("strip.8"));
  CHECK_FALSE(driver.has("strip.9"));
  driver.push("strip.4");
  has_fuzz("0.5");
  for (const char* expected : {"0.625", "0.75"}) {
    driver.send_key(262);
    has_fuzz(expected);
  }
  driver.send_key('Z', {.control = true});
  has_fuzz("0.2");
  choose(driver, "camera.vfov", "vary");
  CHECK(driver.has("strip.26"));
  driver.push("strip.13");
  has_fuzz("0.5");
  choose(driver, "camera.vfov", "vary");
  CHECK_FALSE(driver.has("strip.26"));
  driver.send_key(256);
  driver.await_gone("strip.0");
  choose(driver, "gold.fuzz", "vary");
  driver.wait_until([&] { return driver.has("strip.0"); });
  choose(driver, "gold.fuzz", "vary");  // once more: it goes
  driver.await_gone("strip.0");
}

TEST_CASE("small pictures: the steps hold the present value, and are whole where it is") {
  const Scene scene = load_scene("showroom").scene;
  const std::vector<double> depths = varied_values(*find_slot(scene, "/render/max_depth"), 7, 9);
  CHECK(std::find(depths.begin(), depths.end(), 7) != depths.end());
  for (const double depth : depths) CHECK(depth == std::round(depth));
}

TEST_CASE("small pictures: those of a request that is over are not shown") {
  Scene scene = load_scene("showroom").scene;
  scene.width = 8, scene.height = 6;
  News news;
  SmallRenders renders([&] { news.tell(); });
  renders.request({1, [&](std::size_t) { return std::optional(scene); }, false, 1});
  CHECK(news.wait_until([&] { return news.told() > 0; }));
  renders.request({1, [](std::size_t) { return std::optional<Scene>(); }, false, 1});
  while (!renders.finished()) renders.collect();
  CHECK(renders.pictures() == std::vector<std::shared_ptr<const SmallPicture>>{nullptr});
}

TEST_CASE("the window: keys of a row make a film, which plays and is saved with the scene") {
  Driver driver("film");
  choose(driver, "gold.fuzz", "key");
  CHECK(driver.has("film.track"));
  CHECK(driver.last("message") == "key of Fuzz at frame 0");
  driver.click("film.track", 0.99);
  CHECK(driver.value("film.track") == "119");
  driver.set("gold.fuzz", "0.8");
  choose(driver, "gold.fuzz", "key");
  driver.click("film.track", 0.5);
  CHECK(driver.number("gold.fuzz") == doctest::Approx(0.5).epsilon(0.1));
  driver.undo();
  CHECK(driver.value("gold.fuzz") == "0.8");
  driver.point("film.play");
  const auto push = [&] { driver.press(), driver.release(); };
  push();
  driver.await_value("film.play", "plays");
  const std::string frame = driver.value("film.track");
  driver.wait_until([&] { return driver.value("film.track") != frame; });
  skipped_seconds = skipped_seconds + 4;  // the film lasts for 5 seconds, and begins anew
  driver.wait_until([&] { return driver.number("film.track") < 50; });
  push();
  driver.settle();
  CHECK(driver.value("film.play") == "rests");
  driver.save();
  CHECK(load_scene("scene.json").scene.animation);
}

TEST_CASE("keys: a film grows to the last one and goes with the last one, and goes through stored cameras") {
  Scene scene = load_scene("showroom").scene;
  const Slot slot = *find_slot(scene, "/camera/vfov");
  add_key(scene, slot, 0);
  const int frames = scene.animation->frames;
  add_key(scene, slot, frames + 5);
  CHECK(scene.animation->frames == frames + 6);
  CHECK(has_keys(scene, frames + 5));
  remove_keys(scene, frames + 5);
  CHECK_FALSE(has_keys(scene, frames + 5));
  remove_keys(scene, 0);
  CHECK_FALSE(scene.animation);
  CameraSlots slots{{scene.camera, nullptr}, {scene.camera, nullptr}};
  slots[1].camera.vfov = 10;
  key_cameras(scene, slots);
  CHECK(scene_at(scene, 0).camera.vfov == scene.camera.vfov);
  CHECK(scene_at(scene, 48).camera.vfov == 10);
}

TEST_CASE("the window: adaptive sampling is a setting of the render: it starts over, once, and is undone") {
  Driver driver("adaptive");
  driver.click("render.adaptive.on");
  CHECK(driver.value("render.adaptive.on") == "on");
  driver.click("render.adaptive.on");
  CHECK(driver.submits() == 2);
  driver.undo();
  CHECK(driver.value("render.adaptive.off") == "on");
  CHECK(driver.submits() == 3);
}

TEST_CASE("the window: in a split view both halves get equal seconds, in turns or with half of the threads each") {
  for (const int threads : {1, 2}) {
    Driver driver("halves", [&](WindowOptions& options) {
      options.threads = threads;
      options.scene.scene.render.spp = 1000000;
    });
    driver.push("render.split.on");
    driver.wait_until([&] {
      double a = 0, b = 0;
      std::sscanf(driver.last("halves").c_str(), "A %lf B %lf", &a, &b);
      CHECK(std::abs(a - b) < 0.75);
      return std::min(a, b) > 1;
    });
  }
}

TEST_CASE("the window: two settings side by side, of which one is kept") {
  Driver driver("split");
  driver.click("render.split.on");
  driver.click("render.integrator.mis");
  driver.click("render.split.on");  // it is on
  driver.await_value("split.b", "mis · random   2 spp");
  CHECK(driver.value("split.a").starts_with("path · random"));
  driver.await("accuracy", "B against A: relMSE ");
  const int edits = driver.submits();
  const float divider = driver.left("divider");
  driver.point("divider", 0.5, 0.3);
  CHECK(driver.last("cursor") == "divider");
  driver.press();
  for (int k = 0; k < 6; ++k) driver.move(-30, 3);
  driver.release();
  CHECK(divider - driver.left("divider") == doctest::Approx(180).epsilon(0.05));
  driver.settle();
  CHECK(driver.submits() == edits);
  driver.click("render.split.off");
  CHECK(driver.has("dialog.a"));
  driver.escape();
  CHECK_FALSE(driver.has("dialog.a"));
  CHECK(driver.has("split.a"));
  driver.click("render.split.off");
  driver.click("dialog.a");
  CHECK_FALSE(driver.has("split.a"));
  CHECK(driver.value("render.integrator.path") == "on");
}

}  // namespace tyndall::test::window_rows_test
