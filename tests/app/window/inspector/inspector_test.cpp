#include "app/window/inspector/inspector.h"
#include "app/report/replay.h"
#include "core/compile/compile.h"
#include "core/render/render.h"
#include "core/scene/load.h"
#include "tests/app/window/scenes.h"
#include "tests/support/prepared.h"

#include <algorithm>
#include <cmath>

namespace tyndall::test::inspector_test {

TEST_CASE("the noisy path of a pixel is its brightest sample, and its stops lead from the camera to the light") {
  Scene scene = load_scene("cornell-box").scene;
  scene.width = scene.height = 32;
  scene.render.sharing = false;
  const RenderScene compiled = compile(scene);
  const SceneViewOf view(compiled);
  const NoisyPath found = find_noisy_path(view.view(), 4, 30, 64, [] { return false; });
  CHECK(found.samples == 64);
  double sum = 0, maximum = 0;
  for (std::uint32_t k = 0; k < 64; ++k) {
    const Vec3f light = replay(view.view(), 4, 30, k).radiance;
    const double y = 0.2126 * static_cast<double>(light.x) + 0.7152 * static_cast<double>(light.y) +
                     0.0722 * static_cast<double>(light.z);
    sum += y;
    maximum = std::max(maximum, y);
  }
  CHECK(found.fraction == doctest::Approx(maximum / sum));
  CHECK(found.times_mean == doctest::Approx(64 * maximum / sum));
  const std::vector<PathStop> stops = stops_of(scene, compiled, found.path);
  REQUIRE(!stops.empty());
  CHECK(std::any_of(stops.begin(), stops.end(), [](const PathStop& stop) { return stop.light; }));
  CHECK(std::abs(stops.front().point.y) < 1e-3);  // the floor, in the file's own coordinates
  CHECK(stops.front().text.find("goes on") != std::string::npos);
  const auto lines = path_lines(found, stops);
  CHECK(lines.size() == stops.size() + 2);
  CHECK(lines[1].find("of 64 samples") != std::string::npos);
  int requested = 0;
  CHECK(find_noisy_path(view.view(), 4, 30, 64, [&] { return ++requested == 3; }).samples == 3);
}

TEST_CASE("a long path is told with its first stops and its last one") {
  std::vector<PathStop> stops(40);
  for (std::size_t k = 0; k < stops.size(); ++k) stops[k].text = "stop " + std::to_string(k + 1);
  const auto lines = path_lines({}, stops);
  CHECK(lines.size() == 21);
  CHECK(lines[19] == "    … 22 more");
  CHECK(lines[20] == "40  stop 40");
}

TEST_CASE("the facts of a pixel: value, error, what is shown and seen") {
  Frame frame;
  frame.width = 4, frame.height = 2, frame.grid = {4, 2};
  frame.rgba.assign(4 * 8, 0.5f);
  PixelReport report{.x = 1, .y = 1, .edit = 1, .samples = 64};
  report.mean = {0.5f, 0.25f, 0};
  report.standard_error = {0.05f, 0.025f, 0};
  Scene scene = scene_of({ball("ball", {0, 0, 0})});
  scene.materials[0].name = "gold";
  const auto has = [&](const std::string& begin, const PixelReport& of) {
    const PixelReadout told = pixel_readout(frame, of, scene, {{0}, 3.25, {}});
    return std::any_of(told.lines.begin(), told.lines.end(),
                       [&](const std::string& line) { return line.starts_with(begin); });
  };
  for (const char* line : {"pixel    1, 1", "red      0.5      ± 0.05", "error    13 %", "shown    188 137 0",
                           "samples  64", "object   Ball", "material gold", "depth    3.25"})
    CHECK_MESSAGE(has(line, report), line);
  PixelReport lossy = report, beyond = report;
  lossy.rejected = 3;
  CHECK(has("samples  64, 3 rejected", lossy));
  CleanFrame clean;
  clean.spp = 64;
  clean.rgba.assign(4 * 8, 0.25f);
  frame.clean = std::make_shared<const CleanFrame>(clean);
  CHECK(has("clean    0.25 0.25 0.25", report));
  beyond.y = 2;  // of a larger picture that was there before
  CHECK_FALSE(has("clean", beyond));
  clean.spp = 0;  // coarse: its numbers are not those of this pixel
  frame.clean = std::make_shared<const CleanFrame>(clean);
  CHECK_FALSE(has("clean", report));
  frame.view = View::cost, frame.white = 12;
  CHECK(has("cost     6 rays a path", report));
  CHECK(has("no samples yet", {.x = 0, .y = 0}));
}

TEST_CASE("legends: numbers where a view shows numbers, none where it shows colours") {
  CHECK(legend_of(view_named("samples"), 8).numbers == std::vector<std::string>{"0", "4", "8"});
  CHECK(legend_of(view_named("noise"), 1).numbers.back() == "100 %");
  CHECK(legend_of(view_named("albedo"), 1).title.empty());
  const Legend stops = legend_of(view_named("false colour"), 1);
  CHECK(stops.numbers.size() == stops.colours.size());
  CHECK(stops.numbers[6] == "0");
}

TEST_CASE("a rectangle is drawn from corner to corner in any direction; a click gives an empty one") {
  const Rect image{100, 100, 300, 200};
  const auto draw = [&](float x0, float y0, float x1, float y1) {
    RectangleTool tool;
    Mouse mouse;
    const auto update = [&] { return tool.update(mouse, image, true, 400, 200); };
    CHECK_FALSE(update());
    tool.begin();
    CHECK(tool.active());
    mouse.clicked[0] = mouse.down[0] = true;
    mouse.x = mouse.pressed_x[0] = x0, mouse.y = mouse.pressed_y[0] = y0;
    CHECK_FALSE(update());
    mouse.clicked[0] = false, mouse.x = x1, mouse.y = y1;
    CHECK_FALSE(update());
    mouse.down[0] = false;
    const auto drawn = update();
    CHECK_FALSE(tool.active());
    return drawn;
  };
  CHECK(draw(110, 120, 160, 150) == Region{20, 40, 120, 100});
  CHECK(draw(160, 150, 110, 120) == Region{20, 40, 120, 100});
  CHECK(draw(250, 150, 999, 999) == Region{300, 100, 400, 200});
  CHECK(draw(150, 150, 151, 151) == Region{});
}

}  // namespace tyndall::test::inspector_test
