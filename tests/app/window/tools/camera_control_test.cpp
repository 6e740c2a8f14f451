#include "app/window/tools/camera_control.h"
#include "app/window/document/editor.h"
#include "core/base/math.h"
#include "core/scene/check.h"
#include "tests/app/window/scenes.h"

#include <cmath>

namespace tyndall::test::camera_control_test {

namespace {

Camera example() {
  Camera camera;
  camera.look_from = {0.2, 1.5, 6.2};
  camera.look_at = {0.1, 0.75, 0};
  camera.vfov = 34;
  return camera;
}

bool valid(const Camera& camera) {
  Scene scene;
  scene.camera = camera;
  return !check(scene);
}

/// The camera after many of the same steps.
template <class Step>
Camera repeated(Camera camera, int times, const Step& step) {
  for (int k = 0; k < times; ++k) camera = step(camera);
  return camera;
}

}  // namespace

TEST_CASE("grains are 1, 2 or 5 times a power of ten; rounded numbers are those that a person would type") {
  for (const auto& [size, grain] : {std::pair{0.7, 0.5}, {0.5, 0.5}, {3.9, 2.0}, {1000.0, 1000.0}, {0.00199, 0.001}})
    CHECK(nice_below(size).size() == doctest::Approx(grain).epsilon(1e-12));
  CHECK(decimal_below(99).size() == 10);
  CHECK(decimal_below(0.1).size() == doctest::Approx(0.1));
  CHECK(rounded(0.30000000000000004, DragRounding{1, -2}) == 0.3);
  CHECK(rounded(0.1234, DragRounding{5, -2}) == 0.1);
  CHECK(rounded(0.13, DragRounding{5, -2}) == 0.15);
  CHECK(rounded(1234.6, DragRounding{2, 1}) == 1240);
  CHECK_FALSE(std::signbit(rounded(-0.001, DragRounding{1, -2})));
  CHECK(without_noise(0.1 + 0.2) == 0.3);
  CHECK(without_noise(1e-7 / 3) == about(1e-7 / 3, 1e-11));
  CHECK(without_noise(0) == 0);
}

TEST_CASE("the camera's axes are a right-handed frame that looks at the target, along which it flies") {
  const Camera before = example(), after = fly(before, 1, 2, 3);
  const CameraAxes axes = axes_of(before);
  CHECK(dot(axes.right, axes.up) == doctest::Approx(0).epsilon(1e-12));
  CHECK(dot(cross(axes.right, axes.up), axes.forward) == doctest::Approx(-1));
  CHECK(axes.up.y > 0.9);
  CHECK(length(in_camera_frame(before, before.look_at) - Vec3d{0, 0, target_distance(before)}) < 1e-9);
  const Vec3d flown = after.look_from - before.look_from;
  CHECK(length(Vec3d{dot(flown, axes.right), dot(flown, axes.up), dot(flown, axes.forward)} - Vec3d{1, 2, 3}) < 1e-4);
  CHECK(length(after.look_at - before.look_at - flown) < 1e-4);
}

TEST_CASE("orbit keeps target and distance, the scene follows the mouse, and it stops at the poles") {
  const Camera before = example();
  // A point on the near side of the target moves with the mouse on the screen.
  const Vec3d near = before.look_at - 0.5 * axes_of(before).forward;
  const Camera right = orbit(before, 0.3, 0), down = orbit(before, 0, 0.3);
  CHECK(right.look_at == before.look_at);
  CHECK(target_distance(right) == about(target_distance(before)));
  CHECK(target_distance(down) == about(target_distance(before)));
  CHECK(in_camera_frame(right, near).x > 0.1);
  CHECK(in_camera_frame(down, near).y < -0.1);
  CHECK(down.look_from.y > before.look_from.y);
  CHECK(length(orbit(before, 2 * pi, 0).look_from - before.look_from) < 1e-4);
  for (const double pitch : {100.0, -100.0}) {
    const Camera camera = orbit(before, 0, pitch), further = orbit(camera, 0, pitch);
    CHECK(valid(camera));
    CHECK(length(further.look_from - camera.look_from) < 1e-3);
    CHECK(valid(orbit(further, 1, -pitch)));
  }
}

TEST_CASE("pan moves by the picture's height, dolly scales the distance and never arrives, zoom has its limits") {
  const Camera before = example(), after = pan(before, 0, 1);
  const double height = 2 * std::tan(17 * pi / 180) * target_distance(before);
  CHECK(length(after.look_at - before.look_at) == about(height));
  CHECK(dot(after.look_at - before.look_at, axes_of(before).up) == about(height));
  CHECK(target_distance(after) == about(target_distance(before)));
  CHECK(target_distance(dolly(before, 0.5)) == about(0.5 * target_distance(before)));
  const Camera near = repeated(before, 200, [](const Camera& camera) { return dolly(camera, 1e-3); });
  CHECK(valid(near));
  CHECK(valid(repeated(near, 20, [](const Camera& camera) { return dolly(camera, 1e3); })));
  for (const auto& [factor, end] : {std::pair{1.1, 170.0}, {0.9, 0.1}})
    CHECK(repeated(before, 500, [by = factor](const Camera& camera) { return zoom(camera, by); }).vfov ==
          doctest::Approx(end));
  Camera wide = before;
  wide.vfov = 178;
  CHECK(zoom(wide, 1.1).vfov == doctest::Approx(178));
  CHECK(zoom(wide, 0.9).vfov < 178);
}

TEST_CASE("focusing keeps the lens, or the blur of what is far away") {
  Camera camera = example();
  camera.defocus_angle = 2;
  camera.focus_distance = 10;
  const auto lens = [](const Camera& c) { return focus_distance(c) * std::tan(c.defocus_angle * pi / 360); };
  const Camera plain = focus(camera, 4, false), same_blur = focus(camera, 4, true);
  CHECK(plain.focus_distance == doctest::Approx(4));
  CHECK(lens(plain) == about(lens(camera)));
  CHECK(same_blur.focus_distance == doctest::Approx(4));
  CHECK(same_blur.defocus_angle == 2);
  camera.defocus_angle = 0;
  CHECK(focus(camera, 4, false).defocus_angle == 0);
}

TEST_CASE("a framed ball fits the picture, wide or tall, seen from the same direction") {
  for (const double aspect : {1.6, 0.5}) {
    const Camera camera = frame_sphere(example(), {5, 6, 7}, 2, aspect);
    CHECK(camera.look_at == Vec3d{5, 6, 7});
    CHECK(dot(axes_of(camera).forward, axes_of(example()).forward) == about(1, 1e-6));
    const double half_angle = std::asin(2 / target_distance(camera));
    const double room = std::atan(std::tan(17 * pi / 180) * std::min(1.0, aspect));
    CHECK(half_angle < room);
    CHECK(half_angle > 0.8 * room);
  }
}

TEST_CASE("cameras stay readable: six digits of the distance, also far from the origin") {
  const Camera camera = orbit(example(), 0.123456789, 0.0987654321);
  for (const double v : {camera.look_from.x, camera.look_from.y, camera.look_from.z})
    CHECK(v == std::round(v * 1e5) / 1e5);
  Camera far = example();
  far.look_from = far.look_from + Vec3d{1e6, 0, 0};
  far.look_at = far.look_at + Vec3d{1e6, 0, 0};
  CHECK(valid(orbit(far, 0.5, 0.5)));
}

TEST_CASE("the camera flies while a key is held, by the time between drawings, or a little by a tap; never leaps") {
  Flight flight;
  Camera camera;
  const double second = 0.75 * target_distance(camera);  // the way of one
  CHECK(flight.update({'W'}, 1, camera));                // no time has passed yet
  CHECK(camera == Camera());
  CHECK(flight.update({'W'}, 1.05, camera));
  CHECK(camera.look_from.z == doctest::Approx(-0.05 * second));
  CHECK(target_distance(camera) == doctest::Approx(target_distance(Camera())));
  CHECK(flight.update({'W', 340}, 1.1, camera));  // with Shift, on the left, four times as far
  CHECK(camera.look_from.z == doctest::Approx(-0.25 * second));
  CHECK_FALSE(flight.update({}, 1.2, camera));
  for (const std::set<int>& keys : {std::set<int>{'D', 'A'}, {'E', 'Q'}, {'W', 'S'}, {'X'}})
    CHECK_FALSE(flight.update(keys, 2, camera));
  CHECK(holds_fly_key({'X', 'D'}));
  CHECK_FALSE(holds_fly_key({'X'}));
  flight.update({'D'}, 3, camera);
  flight.update({'D'}, 9, camera);
  CHECK(camera.look_from.x == doctest::Approx(0.1 * second));
  Flight tap;
  Camera tapped;
  CHECK(tap.update({'W'}, 1, tapped));
  for (const double now : {1.4, 1.5}) {
    CHECK_FALSE(tap.update({}, now, tapped));
    CHECK(tapped.look_from.z == doctest::Approx(-second / 60));
  }
}

TEST_CASE("edits while a key or button is held, or the wheel turns, are undone as one, all others one by one") {
  Gestures gestures;
  std::uint64_t before = 0;
  struct Update {
    Gesture what;
    bool is_new;
  };
  using enum Gesture;
  for (const auto& [what, is_new] : {Update{held, true},
                                     {held, false},
                                     {none, true},
                                     {none, true},
                                     {held, true},
                                     {wheel, true},
                                     {wheel, false},
                                     {held, true},
                                     {wheel, true}}) {
    gestures.update(what);
    CHECK((gestures.current() != before) == is_new);
    before = gestures.current();
  }
  const std::uint64_t key = gestures.begin();
  CHECK(key != before);
  gestures.update(wheel);
  CHECK(gestures.current() != key);
}

}  // namespace tyndall::test::camera_control_test
