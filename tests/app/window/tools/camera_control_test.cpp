#include "app/window/tools/camera_control.h"

#include "core/base/math.h"
#include "core/scene/check.h"

#include <doctest/doctest.h>

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

}  // namespace

TEST_CASE("grains are 1, 2 or 5 times a power of ten, and never larger than asked for") {
  CHECK(nice_below(0.7).size() == 0.5);
  CHECK(nice_below(0.5).size() == 0.5);
  CHECK(nice_below(3.9).size() == 2);
  CHECK(nice_below(1000).size() == 1000);
  CHECK(nice_below(0.00199).size() == doctest::Approx(0.001));
  CHECK(decimal_below(99).size() == 10);
  CHECK(decimal_below(0.1).size() == doctest::Approx(0.1));
}

TEST_CASE("rounded numbers are those that a person would type") {
  CHECK(rounded(0.30000000000000004, DragRounding{1, -2}) == 0.3);
  CHECK(rounded(0.1234, DragRounding{5, -2}) == 0.1);
  CHECK(rounded(0.13, DragRounding{5, -2}) == 0.15);
  CHECK(rounded(1234.6, DragRounding{2, 1}) == 1240);
  CHECK_FALSE(std::signbit(rounded(-0.001, DragRounding{1, -2})));
  CHECK(without_noise(0.1 + 0.2) == 0.3);
  CHECK(without_noise(1e-7 / 3) == doctest::Approx(1e-7 / 3).epsilon(1e-11).scale(0));
  CHECK(without_noise(0) == 0);
}

TEST_CASE("the camera's axes are a right-handed frame that looks at the target") {
  const CameraAxes axes = axes_of(example());
  CHECK(dot(axes.right, axes.up) == doctest::Approx(0).epsilon(1e-12));
  CHECK(dot(cross(axes.right, axes.up), axes.forward) == doctest::Approx(-1));
  CHECK(axes.up.y > 0.9);
  const Vec3d target = in_camera_frame(example(), example().look_at);
  CHECK(target.x == doctest::Approx(0).epsilon(1e-12));
  CHECK(target.y == doctest::Approx(0).epsilon(1e-12));
  CHECK(target.z == doctest::Approx(target_distance(example())));
}

TEST_CASE("orbit keeps target and distance, and the scene follows the mouse") {
  const Camera before = example();
  // A point on the near side of the target moves with the mouse on the screen.
  const Vec3d near = before.look_at - 0.5 * axes_of(before).forward;
  const Camera right = orbit(before, 0.3, 0), down = orbit(before, 0, 0.3);
  CHECK(right.look_at == before.look_at);
  CHECK(target_distance(right) == doctest::Approx(target_distance(before)).epsilon(1e-4).scale(0));
  CHECK(target_distance(down) == doctest::Approx(target_distance(before)).epsilon(1e-4).scale(0));
  CHECK(in_camera_frame(right, near).x > 0.1);
  CHECK(in_camera_frame(down, near).y < -0.1);
  CHECK(down.look_from.y > before.look_from.y);
  const Camera around = orbit(before, 2 * pi, 0);
  CHECK(length(around.look_from - before.look_from) < 1e-4);
}

TEST_CASE("orbit stops at the poles: the camera stays valid however far it is dragged") {
  for (const double pitch : {100.0, -100.0}) {
    const Camera camera = orbit(example(), 0, pitch);
    CHECK(valid(camera));
    const Camera further = orbit(camera, 0, pitch);
    CHECK(length(further.look_from - camera.look_from) < 1e-3);
    CHECK(valid(orbit(further, 1, -pitch)));
  }
}

TEST_CASE("pan by one height moves the target's plane by the picture's height") {
  const Camera before = example(), after = pan(before, 0, 1);
  const double height = 2 * std::tan(17 * pi / 180) * target_distance(before);
  CHECK(length(after.look_at - before.look_at) == doctest::Approx(height).epsilon(1e-4).scale(0));
  CHECK(dot(after.look_at - before.look_at, axes_of(before).up) == doctest::Approx(height).epsilon(1e-4).scale(0));
  CHECK(target_distance(after) == doctest::Approx(target_distance(before)).epsilon(1e-4).scale(0));
}

TEST_CASE("dolly scales the distance and never reaches the target") {
  CHECK(target_distance(dolly(example(), 0.5)) ==
        doctest::Approx(0.5 * target_distance(example())).epsilon(1e-4).scale(0));
  Camera camera = example();
  for (int k = 0; k < 200; ++k) camera = dolly(camera, 1e-3);
  CHECK(valid(camera));
  for (int k = 0; k < 20; ++k) camera = dolly(camera, 1e3);
  CHECK(valid(camera));
}

TEST_CASE("zoom stays within its limits, but does not throw a wider camera back") {
  Camera camera = example();
  for (int k = 0; k < 500; ++k) camera = zoom(camera, 1.1);
  CHECK(camera.vfov == doctest::Approx(170));
  for (int k = 0; k < 500; ++k) camera = zoom(camera, 0.9);
  CHECK(camera.vfov == doctest::Approx(0.1));
  camera.vfov = 178;
  CHECK(zoom(camera, 1.1).vfov == doctest::Approx(178));
  CHECK(zoom(camera, 0.9).vfov < 178);
}

TEST_CASE("fly moves eye and target together along the camera's axes") {
  const Camera before = example(), after = fly(before, 1, 2, 3);
  const Vec3d direction = after.look_from - before.look_from;
  const CameraAxes axes = axes_of(before);
  CHECK(dot(direction, axes.right) == doctest::Approx(1).epsilon(1e-4).scale(0));
  CHECK(dot(direction, axes.up) == doctest::Approx(2).epsilon(1e-4).scale(0));
  CHECK(dot(direction, axes.forward) == doctest::Approx(3).epsilon(1e-4).scale(0));
  CHECK(length(after.look_at - before.look_at - direction) < 1e-4);
}

TEST_CASE("focusing keeps the lens, or the blur of what is far away") {
  Camera camera = example();
  camera.defocus_angle = 2;
  camera.focus_distance = 10;
  const auto lens = [](const Camera& c) { return focus_distance(c) * std::tan(c.defocus_angle * pi / 360); };
  const Camera plain = focus(camera, 4, false), same_blur = focus(camera, 4, true);
  CHECK(plain.focus_distance == doctest::Approx(4));
  CHECK(lens(plain) == doctest::Approx(lens(camera)).epsilon(1e-4).scale(0));
  CHECK(same_blur.focus_distance == doctest::Approx(4));
  CHECK(same_blur.defocus_angle == 2);
  camera.defocus_angle = 0;
  CHECK(focus(camera, 4, false).defocus_angle == 0);
}

TEST_CASE("a framed ball fits the picture, wide or tall, seen from the same direction") {
  for (const double aspect : {1.6, 0.5}) {
    const Camera camera = frame_sphere(example(), {5, 6, 7}, 2, aspect);
    CHECK(camera.look_at == Vec3d{5, 6, 7});
    CHECK(dot(axes_of(camera).forward, axes_of(example()).forward) == doctest::Approx(1).epsilon(1e-6).scale(0));
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

}  // namespace tyndall::test::camera_control_test
