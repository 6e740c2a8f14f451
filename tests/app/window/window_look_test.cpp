#include "app/window/accuracy/views.h"
#include "core/image/image_io.h"
#include "core/image/tonemap.h"
#include "tests/app/window/driver.h"

#include <unistd.h>

#include <array>

namespace tyndall::test::window_look_test {

TEST_CASE("the window: the inspector tells of the pixel under the mouse") {
  Driver driver("inspector");
  driver.key('I');
  driver.point("picture", 0.5, 0.45);
  for (const std::string words : {"object   Ball", "samples  2", "material gold", "red      ", "± ", "shown    "})
    driver.await_value("inspector", words);
  driver.point("picture", 0.05, 0.05);
  driver.await_value("inspector", "object   nothing");
  driver.escape();
  CHECK_FALSE(driver.has("inspector"));
}

TEST_CASE("the window: the path of a noisy pixel follows the camera, until an edit changes what it met") {
  Driver driver("path");
  driver.point("picture", 0.5, 0.45);
  driver.key('I', {.shift = true});
  driver.await_value("path.1", "ball");
  driver.await_value("inspector", "the brightest of 2 samples: ");
  const float before = driver.left("path.1");
  driver.drag(0.4, 0.8, 0.45, 0.8);
  CHECK(driver.left("path.1") != before);
  driver.click("gold.fuzz", 0.8);
  CHECK_FALSE(driver.has("path.1"));
}

TEST_CASE("the window: enlarging the picture edits nothing, and clicks still meet what is under the mouse") {
  Driver driver("zoom");
  const float fitting = driver.width("picture");
  driver.key('0');
  CHECK(driver.width("picture") == doctest::Approx(32).epsilon(0.05));
  driver.point("picture");
  driver.hold({.alt = true});
  for (int k = 0; k < 12; ++k) driver.wheel(1);
  CHECK(driver.width("picture") > 400);
  driver.drag(0.5, 0.5, 0.6, 0.6);
  driver.hold({});
  driver.click_ball();
  CHECK(driver.value("picture") == "Ball");
  CHECK(driver.submits() == 1);
  driver.escape();
  driver.key('0');
  driver.key('0');
  CHECK(driver.width("picture") == doctest::Approx(fitting).epsilon(0.01));
}

TEST_CASE("the window: legends tell what numbers mean, and there is none where a view shows colours") {
  Driver driver("legends");
  const std::map<std::string, std::string> legends{{"depth", "depth, scene units: "},
                                                   {"samples", "samples: 0 "},
                                                   {"noise", "estimated relative error: 0 % 50 % 100 %"},
                                                   {"false colour", "stops from middle grey: -6 -5 -4 -3 -2 -1 0"},
                                                   {"cost", "rays of a path: 0 "}};
  for (int k = 0; k < view_count; ++k) {
    if (shows_errors(k)) continue;
    const std::string view = view_entry(k).name;
    driver.find("view: " + view);
    driver.await_value("image.view." + log_name(view), "on");
    const auto legend = legends.find(view);
    legend == legends.end() ? driver.await_gone("legend") : driver.await_value("legend", legend->second);
  }
  driver.click("section.Histogram");
  driver.await_value("histogram", "white, clipped: ");
}

TEST_CASE("the window: a rectangle is refined first, and later the rest") {
  Driver driver("refine");
  driver.chord('B');
  driver.drag(0.4, 0.4, 0.6, 0.6);
  driver.await_value("rectangle", "refined first");
  driver.chord('B');
  CHECK_FALSE(driver.has("rectangle"));
}

TEST_CASE("the window: the raw and the clean picture side by side, with both errors") {
  Driver driver("clean");
  driver.key('N');
  CHECK(driver.value("image.clean.on") == "on");
  driver.click("image.clean.beside_raw");
  driver.await_value("split.b", "clean   2 spp   est. error");
  driver.await_value("split.a", "raw   2 spp   est. error");
  driver.click("image.clean.off");
  CHECK_FALSE(driver.has("divider"));
  CHECK(driver.submits() == 1);
}

TEST_CASE("the window: names that hold anything stand in one line, in the title, too") {
  Driver driver("odd_names", [&](WindowOptions& options) {
    options.scene.source = options.scene.name = "odd\n\x1b[31m %s ##x.json";
    options.scene.scene.objects[1].name = "line\nfeed \x01\x1b[31m %s ## ###";
  });
  driver.click_ball();
  CHECK(driver.value("picture") == "Line\\nfeed \\u0001\\u001b[31m %s ## ###");
  CHECK(driver.platform().title.find('\n') == std::string::npos);
  CHECK(driver.platform().title.find("odd\\n\\u001b[31m %s ##x.json") == 0);
}

namespace {

/// A picture that a program writes, as the command line gives it to a window.
class PicturePipe {
 public:
  PicturePipe() { REQUIRE(::pipe(ends_.data()) == 0); }
  ~PicturePipe() {
    close_writer();
    ::close(ends_[0]);
  }
  PicturePipe(const PicturePipe&) = delete;
  PicturePipe& operator=(const PicturePipe&) = delete;

  /// Must be called after the picture's head was written.
  void give_to(WindowOptions& options, int width, int height) {
    const int in = ends_[0];
    options.picture = std::make_shared<ArrivingPicture>(in, beginning_of(in).bytes, "standard input", PpmCurve::srgb);
    options.scene = {};
    options.scene.name = "standard input";
    options.scene.is_picture = true;
    options.scene.scene.width = width, options.scene.scene.height = height;
    options.scene.scene.render.spp = 1;
  }
  void write(const std::string& text) const {
    REQUIRE(::write(ends_[1], text.data(), text.size()) == static_cast<ssize_t>(text.size()));
  }
  void close_writer() {
    if (ends_[1] >= 0) ::close(ends_[1]);
    ends_[1] = -1;
  }

 private:
  std::array<int, 2> ends_{-1, -1};
};

}  // namespace

TEST_CASE("the window: a picture that a program writes is looked at and saved; only opening leads to a scene") {
  PicturePipe pipe;
  pipe.write("P3 32 20 255\n");
  Driver driver("piped", [&](WindowOptions& options) { pipe.give_to(options, 32, 20); });
  driver.await("state", "row 0 of 20");
  for (int k = 0; k < 10 * 32; ++k) pipe.write("255 128 0 ");
  driver.await("state", "row 10 of 20");
  driver.key('I');
  driver.point("picture", 0.5, 0.25);
  driver.await_value("inspector", "shown    255 128 0");
  driver.point("picture", 0.5, 0.9);
  driver.await_value("inspector", "red      0");
  driver.wheel(1);
  CHECK(driver.has("zoom"));
  for (const char* part : {"camera.vfov", "render.spp", "tab.Camera", "tab.Objects"}) CHECK_FALSE(driver.has(part));
  const std::string no_scene = "this is a picture without a scene";
  driver.chord('S');
  driver.await("message", no_scene);
  driver.key('C');
  for (const char key : {'W', 'A', 'S', 'D'}) driver.fly(key);
  driver.key('2');
  driver.await("message", no_scene);
  driver.set("image.exposure", "1");
  driver.undo();
  CHECK(driver.submits() == 1);
  driver.chord('P');
  driver.await("message", "saved image-001.png");
  CHECK_FALSE(read_embedded_scene("image-001.png"));
  const std::vector<float> rgb = read_image("image-001.png").rgb;
  CHECK(rgb[0] == 1);
  CHECK(rgb[1] == doctest::Approx(srgb_decode(128 / 255.0f)));
  CHECK(rgb.back() == 0);
  pipe.close_writer();
  driver.await("state", "ended at row 10 of 20");
  CHECK(driver.last("message") == "ended at row 10 of 20");
  driver.set("image.exposure", "1");
  driver.chord('O');
  driver.type("scene.json");
  driver.await("message", "opened scene.json");
  driver.settle();
  CHECK(driver.has("camera.vfov"));
  driver.undo();
  driver.await("state", "ended at row 10 of 20");
  CHECK_FALSE(driver.has("camera.vfov"));
  driver.send_key('Q', {.control = true});  // what is exposed is no edit that could be lost
  driver.wait_until([&] { return !driver.is_open(); });
}

}  // namespace tyndall::test::window_look_test
