#include "app/window/handles/handles.h"

#include "app/window/edit/arrange.h"
#include "app/window/tools/camera_control.h"
#include "core/base/math.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

namespace tyndall::test::handle_drag_test {

namespace {

constexpr Rect image{100, 0, 900, 600};

/// A sphere in the middle of a picture, 10 units before the eye, and a turned box elsewhere.
Scene example() {
  Scene scene;
  scene.width = 800, scene.height = 600;
  scene.camera.look_from = {0, 0, 10};
  scene.camera.look_at = {0, 0, 0};
  scene.camera.vfov = 60;
  scene.materials = {{"grey", Vec3d{0.5, 0.5, 0.5}, Lambertian<>{}}};
  scene.objects = {{"ball", Solid3d{Sphere<>{{0, 0, 0}, 1, {}}, 0}, {}},
                   {"box", Solid3d{Box<>{{-1, -1, -1}, {1, 1, 1}}, 0}, {RotateY{20}, Translate{{3, 1, 0}}}}};
  return scene;
}
const Sphere<>& ball(const Scene& scene) { return std::get<Sphere<>>(std::get<Solid3d>(scene.objects[0].kind).shape); }

/// A drag of the sphere's handle of a kind, from its middle by so much.
HandleDrag drag_by(HandleKind kind, double dx, double dy) {
  return {{kind, 0, {}}, {{0}}, {0, 0, 0}, {500, 300}, {500 + dx, 300 + dy}, false, false, {}};
}
std::string dragged(Scene& scene, const HandleDrag& drag) { return apply_drag(scene, frame_of(scene, image, 1), drag); }

/// Where the sphere is seen afterwards, from the middle of the picture.
WindowPoint seen(const Scene& scene) {
  const WindowPoint p = *frame_of(scene, image, 1).point(ball(scene).center);
  return {p.x - 500, p.y - 300};
}

}  // namespace

TEST_CASE("in the camera's plane the object stays under the mouse") {
  Scene scene = example();
  scene.camera.look_from = {4, 3, 8};
  const double away = target_distance(scene.camera);
  dragged(scene, drag_by(HandleKind::plane, 120, -80));
  CHECK(seen(scene).x == doctest::Approx(120).epsilon(0.01).scale(0));
  CHECK(seen(scene).y == doctest::Approx(-80).epsilon(0.01).scale(0));
  CHECK(Projection(scene).depth_of(ball(scene).center) == doctest::Approx(away).epsilon(1e-3).scale(0));
}

TEST_CASE("along an axis only that number changes, and prints short") {
  Scene scene = example();
  const std::string said = dragged(scene, drag_by(HandleKind::along_x, 100, 40));
  CHECK(seen(scene).x == doctest::Approx(100).epsilon(0.01).scale(0));
  CHECK(ball(scene).center.y == 0);
  CHECK(ball(scene).center.z == 0);
  CHECK(ball(scene).center.x == std::round(ball(scene).center.x * 100) / 100);
  CHECK(said.substr(0, 3) == "x +");
  Scene up = example();
  dragged(up, drag_by(HandleKind::along_y, 30, -100));
  CHECK(seen(up).y == doctest::Approx(-100).epsilon(0.01).scale(0));
  CHECK(ball(up).center.x == 0);
}

TEST_CASE("a drag that goes nowhere changes nothing, also with numbers of many digits") {
  for (const HandleKind kind : {HandleKind::plane, HandleKind::along_x, HandleKind::size, HandleKind::rotate}) {
    Scene scene = example();
    std::get<Sphere<>>(std::get<Solid3d>(scene.objects[0].kind).shape) = {{1.0 / 3, 0, 0}, 2.0 / 3, {}};
    const Scene before = scene;
    dragged(scene, drag_by(kind, 0, 0));
    CHECK(scene == before);
  }
}

TEST_CASE("snapping rounds the number itself, not the way; fine snaps ten times as fine") {
  Scene scene = example();
  std::get<Sphere<>>(std::get<Solid3d>(scene.objects[0].kind).shape).center.x = 0.07;
  HandleDrag drag = drag_by(HandleKind::along_x, 100, 0);
  drag.snap = true;  // the picture is 11.5 units high: steps of 0.2
  Scene coarse = scene;
  dragged(coarse, drag);
  CHECK(ball(coarse).center.x == 2);
  drag.fine = true;
  dragged(scene, drag);
  CHECK(ball(scene).center.x == doctest::Approx(1.98).epsilon(0.011).scale(0));
  CHECK(ball(scene).center.x == std::round(ball(scene).center.x * 50) / 50);
}

TEST_CASE("an axis that is seen nearly from its end has a short arrow, which moves evenly with the mouse") {
  Scene scene = example();
  scene.camera.look_from.y += 1;  // z leads a little downwards in the picture
  const PictureFrame frame = frame_of(scene, image, 1);
  const auto handles = handles_of(scene, frame, {{0}}, {0, 0, 0});
  const auto arrow =
      std::find_if(handles.begin(), handles.end(), [](auto& h) { return h.kind == HandleKind::along_z; });
  REQUIRE(arrow != handles.end());
  const WindowPoint start = arrow->points[0], end = arrow->points[1];
  CHECK(std::hypot(end.x - start.x, end.y - start.y) == doctest::Approx(20));
  CHECK(end.y > start.y);
  const auto z_after = [&](double pixels) {
    Scene moved = scene;
    dragged(moved, {*arrow, {{0}}, {0, 0, 0}, end, {end.x, end.y + pixels}, false, false, {}});
    return ball(moved).center.z;
  };
  const double near = z_after(40), far = z_after(-40), horizon = z_after(-280);
  CHECK(near > 0.5);
  CHECK(far == doctest::Approx(-near).epsilon(0.02).scale(0));
  CHECK(horizon == doctest::Approx(-7 * near).epsilon(0.02).scale(0));
}

TEST_CASE("a typed number counts in place of the mouse") {
  Scene scene = example();
  HandleDrag drag = drag_by(HandleKind::along_z, 100, 0);
  drag.typed = -1.25;
  dragged(scene, drag);
  CHECK(ball(scene).center == Vec3d{0, 0, -1.25});
}

TEST_CASE("all selected objects go the same way, each by the numbers that it has") {
  Scene scene = example();
  HandleDrag drag = drag_by(HandleKind::along_x, 100, 0);
  drag.selected = {{0}, {1}};
  dragged(scene, drag);
  const auto& shift = std::get<Translate>(scene.objects[1].transform.back());
  CHECK(shift.offset.x - 3 == doctest::Approx(ball(scene).center.x).epsilon(1e-12).scale(0));
  CHECK(shift.offset.y == 1);
  Scene grouped = example();
  grouped.objects.push_back({"turned", Group{{grouped.objects[1]}}, {RotateY{90}}});
  drag.selected = {{0}, {2, 0}};
  const Vec3d before = middle_of(grouped, {2, 0});
  dragged(grouped, drag);
  CHECK(length(middle_of(grouped, {2, 0}) - before - ball(grouped).center) < 1e-9);
}

TEST_CASE("turning goes with the mouse around the vertical, in steps of half a degree, or of 5 when it snaps") {
  Scene scene = example();
  scene.camera.look_from = {0, 10, 0.001};  // from above: x to the right, z downwards
  HandleDrag drag{{HandleKind::rotate, 0, {}}, {{1}}, {0, 0, 0}, {600, 300}, {500, 200}, false, false, {}};
  Scene rotated = scene;
  dragged(rotated, drag);
  CHECK(angle_of(rotated, {1}) == doctest::Approx(110));  // a quarter against the clock, as rotate_y counts
  drag.to = {599, 282};
  drag.snap = true;
  dragged(scene, drag);
  CHECK(angle_of(scene, {1}) == 30);
  drag.from = {401, 282}, drag.to = {401, 318};  // across 180 degrees: the shorter way
  CHECK(dragged(scene, drag) == "turned by +20°");
}

TEST_CASE("size follows the mouse along the grip's way, and stops above 0") {
  Scene scene = example();
  const PictureFrame frame = frame_of(scene, image, 1);
  const Handle grip = handles_of(scene, frame, {{0}}, {0, 0, 0}).back();
  REQUIRE(grip.kind == HandleKind::size);
  HandleDrag drag{grip, {{0}}, {0, 0, 0}, grip.points[0], grip.points[0], false, false, {}};
  drag.to.x += 40, drag.to.y += 40;
  const double before = std::hypot(grip.points[0].x - 500, grip.points[0].y - 300);
  dragged(scene, drag);
  CHECK(ball(scene).radius == doctest::Approx((before + std::hypot(40, 40)) / before).epsilon(0.02).scale(0));
  Scene small = example();
  drag.to = {0, 0};
  dragged(small, drag);
  CHECK(ball(small).radius > 0);
  CHECK(ball(small).radius < 0.1);
}

TEST_CASE("the handle under the mouse is the one that is meant") {
  const Scene scene = example();
  const PictureFrame frame = frame_of(scene, image, 1);
  const auto handles = handles_of(scene, frame, {{0}}, {0, 0, 0});
  for (const Handle& handle : handles) {
    const auto found = handle_at(handles, handle.points.back(), 1);
    REQUIRE(found);
    CHECK(*found == handle);
  }
  CHECK_FALSE(handle_at(handles, {300, 100}, 1).has_value());
  const std::vector<Handle> near{{HandleKind::along_x, 0, {{0, 0}, {50, 0}}}, {HandleKind::size, 0, {{30, 1}}}};
  CHECK(handle_at(near, {30, 0}, 1)->kind == HandleKind::size);  // a grip on an arrow is meant
  CHECK(handles_of(scene, frame, {}, {}).empty());
  // Seen along z, the arrow of z is but a point and is left out; a sphere has no ring, a box has.
  CHECK_FALSE(std::count_if(handles.begin(), handles.end(), [](auto& h) { return h.kind == HandleKind::along_z; }));
  CHECK_FALSE(std::count_if(handles.begin(), handles.end(), [](auto& h) { return h.kind == HandleKind::rotate; }));
  const auto of_box = handles_of(scene, frame, {{1}}, {3, 1, 0});
  CHECK(std::count_if(of_box.begin(), of_box.end(), [](auto& h) { return h.kind == HandleKind::rotate; }) == 1);
  CHECK(std::count_if(of_box.begin(), of_box.end(), [](auto& h) { return h.kind == HandleKind::size; }) == 6);
}

TEST_CASE("from wherever a box is seen, its grips keep off the arrows, and both can be taken") {
  for (const double size : {0.1, 0.5, 1.0})
    for (const double height : {0.1, 0.5, 2.0, 8.0})
      for (int degrees = 3; degrees < 360; degrees += 11) {
        Scene scene = example();
        std::get<Box<>>(std::get<Solid3d>(scene.objects[1].kind).shape) = {{-size, -size, -size}, {size, size, size}};
        scene.objects[1].transform.clear();
        const double angle = degrees * pi / 180;
        scene.camera.look_from = {10 * std::cos(angle), height, 10 * std::sin(angle)};
        const auto handles = handles_of(scene, frame_of(scene, image, 1), {{1}}, {0, 0, 0});
        for (const Handle& handle : handles) {
          if (handle.kind == HandleKind::rotate || handle.kind == HandleKind::plane) continue;
          const auto found = handle_at(handles, handle.points.back(), 1);
          INFO(size, " ", height, " ", degrees, " ", static_cast<int>(handle.kind), " ", handle.grip);
          REQUIRE(found);
          CHECK((found->kind == HandleKind::size) == (handle.kind == HandleKind::size));
        }
      }
}

}  // namespace tyndall::test::handle_drag_test
