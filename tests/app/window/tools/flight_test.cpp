#include "app/window/tools/camera_control.h"

#include "app/window/document/editor.h"

#include <doctest/doctest.h>

#include <utility>

namespace tyndall::test::flight_test {

TEST_CASE("the camera flies while a key is held, by the time between drawings") {
  Flight flight;
  Camera camera;
  const double distance = target_distance(camera);
  CHECK(flight.update({'W'}, 1, camera));  // no time has passed yet
  CHECK(camera == Camera());
  CHECK(flight.update({'W'}, 1.05, camera));
  CHECK(camera.look_from.z == doctest::Approx(-0.05 * 0.75 * distance));
  CHECK(target_distance(camera) == doctest::Approx(distance));
  CHECK(flight.update({'W', 340}, 1.1, camera));  // with Shift, on the left, four times as far
  CHECK(camera.look_from.z == doctest::Approx(-0.25 * 0.75 * distance));
  CHECK_FALSE(flight.update({}, 1.2, camera));
}

TEST_CASE("opposite keys and other keys do not move the camera, and a slow drawing does not make it leap") {
  Flight flight;
  Camera camera;
  for (const auto& [one, other] : {std::pair{'D', 'A'}, {'E', 'Q'}, {'W', 'S'}})
    CHECK_FALSE(flight.update({one, other}, 1, camera));
  CHECK_FALSE(flight.update({'X'}, 1, camera));
  CHECK(holds_fly_key({'X', 'D'}));
  CHECK_FALSE(holds_fly_key({'X'}));
  flight.update({'D'}, 2, camera);
  flight.update({'D'}, 9, camera);
  CHECK(camera.look_from.x == doctest::Approx(0.1 * 0.75 * target_distance(camera)));
}

TEST_CASE("a key of flight that is tapped within one drawing moves the camera a little, once") {
  Flight flight;
  Camera camera;
  const double distance = target_distance(camera);
  CHECK(flight.update({'W'}, 1, camera));
  CHECK_FALSE(flight.update({}, 1.4, camera));
  CHECK(camera.look_from.z == doctest::Approx(-0.75 * distance / 60));
  const Camera after = camera;
  CHECK_FALSE(flight.update({}, 1.5, camera));
  CHECK(camera == after);
}

TEST_CASE("edits while a key or button is held are undone as one, all others one by one") {
  Gestures gestures;
  gestures.update(Gesture::held);
  const std::uint64_t first = gestures.current();
  gestures.update(Gesture::held);
  CHECK(gestures.current() == first);
  gestures.update(Gesture::none);
  const std::uint64_t second = gestures.current();
  CHECK(second != first);
  gestures.update(Gesture::none);
  CHECK(gestures.current() != second);
  const std::uint64_t before = gestures.current();
  CHECK(gestures.begin() != before);
  gestures.update(Gesture::held);
  CHECK(gestures.current() != before);
}

TEST_CASE("a button that is pressed while the wheel still turns is a step of its own, and so is an edit by a key") {
  Gestures gestures;
  gestures.update(Gesture::wheel);
  const std::uint64_t wheel = gestures.current();
  gestures.update(Gesture::wheel);
  CHECK(gestures.current() == wheel);
  gestures.update(Gesture::held);
  const std::uint64_t held = gestures.current();
  CHECK(held != wheel);
  gestures.update(Gesture::wheel);
  CHECK(gestures.current() != held);
  const std::uint64_t key = gestures.begin();
  gestures.update(Gesture::wheel);
  CHECK(gestures.current() != key);
}

}  // namespace tyndall::test::flight_test
