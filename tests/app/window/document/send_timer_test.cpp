#include "app/window/system/pacing.h"

#include <doctest/doctest.h>

namespace tyndall::test::send_timer_test {

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

}  // namespace tyndall::test::send_timer_test
