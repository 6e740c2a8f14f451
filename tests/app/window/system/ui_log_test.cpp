#include "app/window/system/ui_log.h"

#include "tests/support/scratch.h"

#include <doctest/doctest.h>

#include <filesystem>

namespace tyndall::test::ui_log_test {
namespace fs = std::filesystem;

TEST_CASE("the log says what changed, and at the end how long things took") {
  const fs::path file = scratch_folder("ui_log") / "ui.log";
  {
    UiLog log(file);
    for (int drawing = 0; drawing < 3; ++drawing) {
      log.widget("gold.fuzz", {1, 2, 3, 4}, drawing < 2 ? "0.1" : "0.2");
      if (drawing == 0) log.widget("a name", {0, 0, 1, 1}, "x");
      log.end_of_widgets();
    }
    log.submitted(1, 10, false);
    log.submitted(2, 10.5, true);
    Frame frame;
    frame.edit = 1;
    frame.step = 8;
    frame.first_picture_ms = 15;
    log.shown(frame, 10.02);
    frame.step = 1;
    frame.spp = 1;
    log.shown(frame, 10.05);
    frame.clean = std::make_shared<const CleanFrame>();
    for (const double now : {10.25, 10.5}) log.shown(frame, now);
    frame.clean = nullptr;
    frame.edit = 2;
    log.shown(frame, 10.6);
    frame.clean = std::make_shared<const CleanFrame>();
    log.shown(frame, 10.75);
    log.drawn(0.002, true);
    Mouse mouse;
    mouse.x = mouse.y = -3e38f;
    log.mouse(mouse);
    mouse.x = 12, mouse.y = 34, mouse.down[0] = true, mouse.typing = true;
    log.mouse(mouse);
    mouse.down[0] = false, mouse.wheel = -1;
    log.mouse(mouse);
    for (int k = 0; k < 2; ++k) log.rest();
    log.line("key 82");
    log.rest();
  }
  CHECK(read_text(file) ==
        "widget gold.fuzz 1 2 3 4 0.1\nwidget a_name 0 0 1 1 x\ngone a_name\nwidget gold.fuzz 1 2 3 4 0.2\n"
        "submit 1\nsubmit 2\nframe 1 0 8 20.0 15.0\nframe 1 1 1 50.0 15.0\nframe 1 1 1 250.0 15.0\n"
        "frame 1 1 1 500.0 15.0\nframe 2 1 1 100.0 15.0\nframe 2 1 1 250.0 15.0\ndrawn 2.00 1\n"
        "mouse none\nbuttons 0 0 0\nkeyboard shortcuts\nmouse 12 34\nbuttons 1 0 0\nkeyboard control\n"
        "buttons 0 0 0\nwheel -1\nrest\nkey 82\nrest\n"
        "latency n 2 p50 20.0 p95 100.0 p99 100.0 max 100.0 ms\n"
        "latency camera n 1 p50 100.0 p95 100.0 p99 100.0 max 100.0 ms\n"
        "latency other n 1 p50 20.0 p95 20.0 p99 20.0 max 20.0 ms\n"
        "latency clean n 1 p50 250.0 p95 250.0 p99 250.0 max 250.0 ms\n"
        "cpu picture n 1 p50 2.0 p95 2.0 p99 2.0 max 2.0 ms\ncpu plain n 0 p50 0.0 p95 0.0 p99 0.0 max 0.0 ms\n");
  CHECK_THROWS_AS(UiLog("/no/such/folder/log"), std::exception);
}

}  // namespace tyndall::test::ui_log_test
