#include "app/window/edit/arrange.h"
#include "app/window/handles/handles.h"
#include "app/window/tools/camera_control.h"
#include "core/base/math.h"
#include "tests/app/window/scenes.h"

#include <algorithm>
#include <cmath>

namespace tyndall::test::handle_drag_test {

namespace {

constexpr Rect image{100, 0, 900, 600};

/// A sphere in the middle of a picture, 10 units before the eye, and a turned box elsewhere.
Scene example() {
  return seen_scene(
      800, 600, {0, 0, 10}, 60,
      {ball("ball", {0, 0, 0}), solid(Box<>{{-1, -1, -1}, {1, 1, 1}}, {RotateY{20}, Translate{{3, 1, 0}}})});
}
PictureFrame frame(const Scene& scene) { return frame_of(scene, image, 1); }

/// A drag of the sphere's handle of a kind, from its middle by so much.
HandleDrag drag_by(HandleKind kind, double dx, double dy) {
  return {{kind, 0, {}}, {{0}}, {0, 0, 0}, {500, 300}, {500 + dx, 300 + dy}, false, false, {}};
}
Scene dragged(Scene scene, const HandleDrag& drag) {
  apply_drag(scene, frame(scene), drag);
  return scene;
}
const Vec3d& center(const Scene& scene) { return shape(scene).center; }

/// Where the sphere is seen afterwards, from the middle of the picture.
WindowPoint seen(const Scene& scene) {
  const WindowPoint p = *frame(scene).point(center(scene));
  return {p.x - 500, p.y - 300};
}
std::ptrdiff_t count(const std::vector<Handle>& handles, HandleKind kind) {
  return std::count_if(handles.begin(), handles.end(), [&](const Handle& handle) { return handle.kind == kind; });
}

}  // namespace

TEST_CASE("in the camera's plane the object stays under the mouse; along an axis only that number changes") {
  Scene scene = example();
  scene.camera.look_from = {4, 3, 8};
  const Scene moved = dragged(scene, drag_by(HandleKind::plane, 120, -80));
  CHECK(seen(moved).x == about(120, 0.01));
  CHECK(seen(moved).y == about(-80, 0.01));
  CHECK(Projection(moved).depth_of(center(moved)) == about(target_distance(scene.camera), 1e-3));
  Scene right = example();
  CHECK(apply_drag(right, frame(right), drag_by(HandleKind::along_x, 100, 40)).starts_with("x +"));
  CHECK(seen(right).x == about(100, 0.01));
  const double x = center(right).x;
  CHECK(center(right) == Vec3d{std::round(x * 100) / 100, 0, 0});
  const Scene up = dragged(example(), drag_by(HandleKind::along_y, 30, -100));
  CHECK(seen(up).y == about(-100, 0.01));
  CHECK(center(up).x == 0);
}

TEST_CASE("a drag that goes nowhere changes nothing, also with numbers of many digits") {
  Scene scene = example();
  shape(scene) = {{1.0 / 3, 0, 0}, 2.0 / 3, {}};
  for (const HandleKind kind : {HandleKind::plane, HandleKind::along_x, HandleKind::size, HandleKind::rotate})
    CHECK(dragged(scene, drag_by(kind, 0, 0)) == scene);
}

TEST_CASE("snapping rounds the number itself, not the way; fine snaps ten times as fine; a typed number counts") {
  Scene scene = example();
  shape(scene).center.x = 0.07;
  HandleDrag drag = drag_by(HandleKind::along_x, 100, 0);
  drag.snap = true;  // the picture is 11.5 units high: steps of 0.2
  CHECK(center(dragged(scene, drag)).x == 2);
  drag.fine = true;
  const double fine = center(dragged(scene, drag)).x;
  CHECK(fine == about(1.98, 0.011));
  CHECK(fine == std::round(fine * 50) / 50);
  drag = drag_by(HandleKind::along_z, 100, 0);
  drag.typed = -1.25;
  CHECK(center(dragged(example(), drag)) == Vec3d{0, 0, -1.25});
}

TEST_CASE("an axis that is seen nearly from its end has a short arrow, which moves evenly with the mouse") {
  Scene scene = example();
  scene.camera.look_from.y += 1;  // z leads a little downwards in the picture
  const auto handles = handles_of(scene, frame(scene), {{0}}, {0, 0, 0});
  const auto arrow =
      std::find_if(handles.begin(), handles.end(), [](auto& h) { return h.kind == HandleKind::along_z; });
  REQUIRE(arrow != handles.end());
  const WindowPoint start = arrow->points[0], end = arrow->points[1];
  CHECK(std::hypot(end.x - start.x, end.y - start.y) == doctest::Approx(20));
  CHECK(end.y > start.y);
  const auto z_after = [&](double pixels) {
    return center(dragged(scene, {*arrow, {{0}}, {0, 0, 0}, end, {end.x, end.y + pixels}, false, false, {}})).z;
  };
  const double near = z_after(40);
  CHECK(near > 0.5);
  CHECK(z_after(-40) == about(-near, 0.02));
  CHECK(z_after(-280) == about(-7 * near, 0.02));  // the horizon
}

TEST_CASE("all selected objects go the same way, each by the numbers that it has") {
  HandleDrag drag = drag_by(HandleKind::along_x, 100, 0);
  drag.selected = {{0}, {1}};
  const Scene scene = dragged(example(), drag);
  const Vec3d shift = std::get<Translate>(scene.objects[1].transform.back()).offset;
  CHECK(shift.x - 3 == about(center(scene).x, 1e-12));
  CHECK(shift.y == 1);
  Scene grouped = example();
  grouped.objects.push_back({"turned", Group{{grouped.objects[1]}}, {RotateY{90}}});
  drag.selected = {{0}, {2, 0}};
  const Scene moved = dragged(grouped, drag);
  CHECK(length(middle_of(moved, {2, 0}) - middle_of(grouped, {2, 0}) - center(moved)) < 1e-9);
}

TEST_CASE("turning goes with the mouse around the vertical, in steps of half a degree, or of 5 when it snaps") {
  Scene scene = example();
  scene.camera.look_from = {0, 10, 0.001};  // from above: x to the right, z downwards
  HandleDrag drag{{HandleKind::rotate, 0, {}}, {{1}}, {0, 0, 0}, {600, 300}, {500, 200}, false, false, {}};
  CHECK(angle_of(dragged(scene, drag), {1}) == doctest::Approx(110));  // against the clock, as rotate_y counts
  drag.to = {599, 282};
  drag.snap = true;
  scene = dragged(scene, drag);
  CHECK(angle_of(scene, {1}) == 30);
  drag.from = {401, 282}, drag.to = {401, 318};  // across 180 degrees: the shorter way
  CHECK(apply_drag(scene, frame(scene), drag) == "turned by +20°");
}

TEST_CASE("size follows the mouse along the grip's way, and stops above 0") {
  const Scene scene = example();
  const Handle grip = handles_of(scene, frame(scene), {{0}}, {0, 0, 0}).back();
  REQUIRE(grip.kind == HandleKind::size);
  const WindowPoint at = grip.points[0];
  HandleDrag drag{grip, {{0}}, {0, 0, 0}, at, {at.x + 40, at.y + 40}, false, false, {}};
  const double before = std::hypot(at.x - 500, at.y - 300);
  CHECK(shape(dragged(scene, drag)).radius == about((before + std::hypot(40, 40)) / before, 0.02));
  drag.to = {0, 0};
  const double smallest = shape(dragged(scene, drag)).radius;
  CHECK(smallest > 0);
  CHECK(smallest < 0.1);
}

TEST_CASE("the handle under the mouse is the one that is meant") {
  const Scene scene = example();
  const auto handles = handles_of(scene, frame(scene), {{0}}, {0, 0, 0});
  for (const Handle& handle : handles) CHECK(handle_at(handles, handle.points.back(), 1) == handle);
  CHECK_FALSE(handle_at(handles, {300, 100}, 1));
  const std::vector<Handle> near{{HandleKind::along_x, 0, {{0, 0}, {50, 0}}}, {HandleKind::size, 0, {{30, 1}}}};
  CHECK(handle_at(near, {30, 0}, 1)->kind == HandleKind::size);  // a grip on an arrow is meant
  CHECK(handles_of(scene, frame(scene), {}, {}).empty());
  // Seen along z, the arrow of z is but a point and is left out; a sphere has no ring, a box has.
  CHECK(count(handles, HandleKind::along_z) == 0);
  CHECK(count(handles, HandleKind::rotate) == 0);
  const auto of_box = handles_of(scene, frame(scene), {{1}}, {3, 1, 0});
  CHECK(count(of_box, HandleKind::rotate) == 1);
  CHECK(count(of_box, HandleKind::size) == 6);
}

TEST_CASE("from wherever a box is seen, its grips keep off the arrows, and both can be taken") {
  for (const double size : {0.1, 0.5, 1.0})
    for (const double height : {0.1, 0.5, 2.0, 8.0})
      for (int degrees = 3; degrees < 360; degrees += 11) {
        Scene scene = example();
        shape<Box<>>(scene, 1) = {{-size, -size, -size}, {size, size, size}};
        scene.objects[1].transform.clear();
        const double angle = degrees * pi / 180;
        scene.camera.look_from = {10 * std::cos(angle), height, 10 * std::sin(angle)};
        const auto handles = handles_of(scene, frame(scene), {{1}}, {0, 0, 0});
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
