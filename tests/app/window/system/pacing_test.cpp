#include "app/window/system/pacing.h"
#include "app/window/system/layout.h"
#include "tests/app/window/scenes.h"

#include <cmath>

namespace tyndall::test::pacing_test {

TEST_CASE("as long as nothing happens nothing is drawn; a burst of events is drawn at most every 16 ms") {
  Pacing idle;
  double now = 10;
  int drawn = 0;
  for (; idle.wait(now) < 1e6; ++drawn) {
    now += idle.wait(now);
    idle.on_drawn(now);
    REQUIRE(drawn < 10);
  }
  CHECK(drawn == 3);
  CHECK(std::isinf(idle.wait(now + 1000)));
  Pacing busy;
  drawn = 0;
  for (now = 0; now < 1; now += 0.0005) {
    busy.on_event();
    if (busy.wait(now) > 0) continue;
    busy.on_drawn(now);
    ++drawn;
  }
  CHECK(drawn >= 55);
  CHECK(drawn <= 63);
}

TEST_CASE("an event is drawn at once, and the drawings that follow it leave time for new pictures") {
  Pacing pacing;
  pacing.on_drawn(1);
  pacing.on_event();
  CHECK(pacing.wait(1.02) == 0);
  pacing.on_drawn(1.02);
  CHECK(pacing.wait(1.02) == doctest::Approx(echo_interval));
  pacing.wake_at(1.03);  // something that moves by itself asks to be drawn earlier
  CHECK(pacing.wait(1.02) == doctest::Approx(min_frame_interval));
  pacing.on_drawing();
  pacing.on_drawn(1.06);
  CHECK(pacing.wait(1.06) == doctest::Approx(echo_interval));
  pacing.on_event();
  CHECK(pacing.wait(1.08) == 0);
}

TEST_CASE("pictures: at once after an edit, then every 0.1 s, then ever slower") {
  struct Interval {
    double seconds;
    int pictures;
    double expected;
  };
  for (const auto& [seconds, pictures, expected] :
       {Interval{0.01, 0, 0}, {0.01, 2, 0}, {0.01, 3, 0.1}, {3, 50, 0.3}, {100, 500, 0.5}})
    CHECK(picture_interval(seconds, pictures) == doctest::Approx(expected));
  Pacing pacing;
  pacing.on_edit(1, 100);
  for (int k = 0; k < 20; ++k) pacing.on_picture(1, 100 + k);
  CHECK(pacing.picture_due() > 119.4);
  pacing.on_edit(2, 119.1);
  CHECK(pacing.picture_due() <= 119.1);
  pacing.on_picture(1, 119.15);  // a picture of the edit before does not count
  for (int k = 0; k < 2; ++k) {
    pacing.on_picture(2, 119.2);
    CHECK(pacing.picture_due() <= 119.2);
  }
  pacing.on_picture(2, 119.2);
  CHECK(pacing.picture_due() == doctest::Approx(119.3));
}

TEST_CASE("something that moves by itself wakes the window, once for each drawing that asks for it") {
  Pacing pacing;
  for (double now = 0; now < 0.2; now += 0.02) pacing.on_drawn(now);
  pacing.wake_at(6);
  CHECK(pacing.wait(1) == doctest::Approx(5));
  CHECK(pacing.wait(7) == 0);
  pacing.on_drawing();
  pacing.wake_at(9);  // another message came meanwhile
  pacing.on_drawn(7);
  CHECK(pacing.wait(8) == doctest::Approx(1));
  pacing.on_drawing();
  pacing.on_drawn(9);
  CHECK(std::isinf(pacing.wait(10)));
}

TEST_CASE("the picture keeps its aspect in the middle of what the column leaves; no size is too small") {
  const Layout layout = make_layout(1600, 900, 1280, 800, 1, column_width);
  CHECK(layout.column.width() == column_width);
  CHECK(layout.status.height() == status_height);
  CHECK(layout.image.width() / layout.image.height() == about(1.6, 0.002));
  CHECK(layout.image.x1 <= layout.column.x0);
  CHECK(layout.image.y1 <= layout.status.y0);
  const Layout exact = make_layout(1280 + column_width, 800 + status_height, 1280, 800, 1, column_width);
  CHECK(exact.image == Rect{0, 0, 1280, 800});
  CHECK(make_layout(1600, 900, 1280, 800, 1, 0).column.width() == 0);
  CHECK(make_layout(3200, 1800, 1280, 800, 2, column_width).column.width() == 2 * column_width);
  for (const float w : {0.0f, 1.0f, 40.0f, 400.0f})
    for (const float h : {0.0f, 1.0f, 29.0f, 31.0f}) {
      const Layout small = make_layout(w, h, 1280, 800, 1, column_width);
      for (const Rect& r : {small.area, small.image, small.column, small.status}) {
        CHECK(std::min(r.width(), r.height()) >= 0);
        CHECK(r.x1 <= w + 1);
        CHECK(r.y1 <= h + 1);
      }
    }
}

TEST_CASE("an edit is sent when the picture before was seen, and after 0.4 s in any case") {
  SendTimer timer;
  CHECK_FALSE(timer.due(true, 5));
  CHECK(timer.latest() > 1e300);
  timer.on_send(5);
  timer.on_change(5.1);
  timer.on_change(5.2);
  CHECK(timer.changed_at() == 5.1);
  CHECK(timer.due(true, 5.2));
  CHECK_FALSE(timer.due(false, 5.2));
  CHECK(timer.latest() == doctest::Approx(5.4));
  CHECK(timer.due(false, 5.41));
  timer.on_send(5.41);
  CHECK_FALSE(timer.waits());
  CHECK_FALSE(timer.due(true, 9));
}

}  // namespace tyndall::test::pacing_test
