#include "app/window/gallery/gallery.h"

#include <doctest/doctest.h>

namespace tyndall::test::camera_slots_test {

TEST_CASE("stored cameras: the next one follows the present one, round and round") {
  Camera front, side;
  side.look_from = {4, 0, 0};
  Camera other;
  other.vfov = 20;
  CHECK_FALSE(next_slot({}, front));
  const CameraSlots slots{{front, nullptr}, {side, nullptr}};
  CHECK(next_slot(slots, front) == 1);
  CHECK(next_slot(slots, side) == 0);
  CHECK(next_slot(slots, other) == 0);
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
  CHECK(rgb[3 * (10 * 96 + 10)] == doctest::Approx(188).epsilon(0.05).scale(0));
  CHECK(rgb[3 * (10 * 96 + 80)] == 0);
  frame.view = View::noise;
  CHECK(small_picture(frame, {}).rgb.empty());  // the picture itself is not there yet
  frame.beauty = frame.rgba;
  CHECK(small_picture(frame, {}).rgb == rgb);
}

}  // namespace tyndall::test::camera_slots_test
