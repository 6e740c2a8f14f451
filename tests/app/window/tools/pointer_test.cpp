#include "app/window/tools/pointer.h"
#include "app/window/tools/camera_control.h"
#include "app/window/tools/projection.h"
#include "app/window/tools/selection.h"
#include "tests/app/window/scenes.h"

#include <cmath>
#include <limits>

namespace tyndall::test::pointer_test {

namespace {

/// A picture of 400 x 300 units in a window, a camera, and a mouse to press and move.
struct Hand {
  PointerTool tool;
  PressedButton clicked = PressedButton::none;
  Mouse mouse;
  Camera camera;
  Layout layout = make_layout(400, 330, 400, 300, 1, 0);

  /// Whether the left button was clicked.
  bool update(bool free = true) {
    clicked = tool.update(mouse, layout, 1, free, 10, camera);
    mouse.dx = mouse.dy = mouse.wheel = 0;
    for (bool& button : mouse.clicked) button = false;
    return clicked == PressedButton::left;
  }
  /// Presses a button; whether the tool has it then.
  bool press(int button, float x, float y, bool free = true) {
    mouse.x = mouse.pressed_x[button] = x, mouse.y = mouse.pressed_y[button] = y;
    mouse.clicked[button] = mouse.down[button] = true;
    CHECK_FALSE(update(free));
    return tool.is_pressed();
  }
  bool move(float dx, float dy) {
    mouse.x += dx, mouse.y += dy, mouse.dx = dx, mouse.dy = dy;
    return update();
  }
  bool release(int button = 0) {
    mouse.down[button] = false;
    return update();
  }
};

}  // namespace

TEST_CASE("a press without movement is a click, also if the hand trembles a little, or no drawing was between them") {
  Hand hand;
  CHECK(hand.press(0, 100, 100));
  CHECK_FALSE(hand.move(2, 2));
  CHECK(hand.release());
  CHECK_FALSE(hand.tool.is_pressed());
  CHECK(hand.camera == Camera());
  hand.press(1, 100, 100);
  CHECK_FALSE(hand.release(1));
  CHECK(hand.clicked == PressedButton::right);
  Hand quick;
  quick.mouse.x = quick.mouse.y = quick.mouse.pressed_x[0] = quick.mouse.pressed_y[0] = 100;
  quick.mouse.clicked[0] = true;
  CHECK(quick.update());
}

TEST_CASE("a drag goes on outside the picture, but does not begin there or while a dialog asks") {
  Hand hand;
  CHECK_FALSE(hand.press(0, 100, 100, false));
  CHECK_FALSE(hand.press(0, 100, 320));  // on the status line, below the picture
  hand.mouse.taken = true;
  CHECK_FALSE(hand.press(0, 100, 100));
  hand.mouse.taken = false;
  CHECK(hand.camera == Camera());
  CHECK(hand.press(0, 100, 100));
  hand.move(-500, 0);
  CHECK_FALSE(hand.camera == Camera());
}

TEST_CASE("a click knows its pixel, also at the edges; clicks are at one place if mouse and camera stay") {
  const Rect image{100, 50, 300, 150};
  const auto pixel = [&](float x, float y) {
    const PictureClick click = click_at(image, x, y, 20, 10);
    return std::pair(click.x, click.y);
  };
  CHECK(pixel(100, 50) == std::pair(0, 0));
  CHECK(pixel(299.99f, 149.99f) == std::pair(19, 9));
  CHECK(pixel(200, 100).second == 5);
  CHECK(click_at(image, 200, 100, 20, 10).at.x == doctest::Approx(0.5));
  ClickPlace place;
  Camera camera;
  CHECK_FALSE(place.again(10, 10, 1, camera));
  CHECK(place.again(13, 10, 1, camera));
  CHECK_FALSE(place.again(30, 10, 1, camera));
  camera.vfov = 50;
  CHECK_FALSE(place.again(30, 10, 1, camera));
}

TEST_CASE("fog is selected where nothing else is, or by a second click") {
  const Scene scene = seen_scene(100, 100, {0, 0, 0}, 90, {ball("", {0, 0, -5}), fog(Sphere<>{{0, 0, -2}, 0.5, {}})});
  const Renderer::Pick on_sphere{{0}, 4, {0, 0, -4}}, nothing{};
  const auto clicked = [&](const Renderer::Pick& pick, double x, const ObjectPath& selected, bool again) {
    return clicked_object(scene, pick, {x, 0.5}, selected, again);
  };
  CHECK(clicked(on_sphere, 0.5, {}, false) == ObjectPath{0});
  CHECK(clicked(on_sphere, 0.5, {0}, true) == ObjectPath{1});
  CHECK(clicked(on_sphere, 0.5, {1}, true) == ObjectPath{0});
  CHECK(clicked(on_sphere, 0.5, {0}, false) == ObjectPath{0});
  CHECK(clicked(nothing, 0.5, {}, false) == ObjectPath{1});
  CHECK(clicked(nothing, 0.99, {}, false).empty());
}

TEST_CASE("clicks at one place go on to what lies behind, and from the last object to the first again") {
  const Scene scene = seen_scene(
      100, 100, {0, 0, 0}, 90,
      {ball("", {0, 0, -9}), ball("", {0, 0, -4}, 2), ball("", {0, 0, -4}, -1.5), fog(Sphere<>{{0, 0, -20}, 3, {}})});
  const Renderer::Pick front{{1}, 2, {0, 0, -2}};
  ObjectPath now = clicked_object(scene, front, {0.5, 0.5}, {}, false);
  std::vector<ObjectPath> seen{now};
  for (int k = 0; k < 4; ++k) seen.push_back(now = clicked_object(scene, front, {0.5, 0.5}, now, true));
  CHECK(seen == std::vector<ObjectPath>{{1}, {3}, {2}, {0}, {1}});
}

namespace {

Scene seen(std::vector<Object> objects) { return seen_scene(200, 100, {0, 0, 10}, 60, std::move(objects)); }

/// A matt sphere, and a group, turned and moved, of a glass sphere and a box of media.
Scene example() {
  const Object inner = fog(Box<>{{0, 0, 0}, {1, 1, 1}}, {Translate{{10, 0, 0}}});
  return seen({ball("matt", {0, 0, 0}),
               {"pair", Group{{ball("", {1, 0, 0}, 0.5, 1), inner}}, {RotateY{90}, Translate{{0, 2, 0}}}}});
}

/// The medium that a line of sight enters first, if it does so before `depth` along the axis; empty: none.
ObjectPath medium_at(const Scene& scene, double x, double depth = std::numeric_limits<double>::infinity()) {
  for (const ObjectUnder& object : objects_under(scene, {x, 0.5}))
    if (object.medium && -object.distance * Projection(scene).view_ray({x, 0.5}).direction.z < depth)
      return object.path;
  return {};
}

}  // namespace

TEST_CASE("objects by path: through groups, and nothing where there is nothing") {
  Scene scene = example();
  CHECK(find_object(scene, {0})->name == "matt");
  CHECK(std::string(kind_name(*find_object(scene, {1, 1}))) == "medium");
  for (const ObjectPath& path : {ObjectPath{}, {2}, {-1}, {0, 0}, {1, 2}, {1, 0, 0}})
    CHECK_FALSE(find_object(scene, path));
  CHECK(leaves(scene) == std::vector<ObjectPath>{{0}, {1, 0}, {1, 1}});
  CHECK(title_of(scene, {0}) == "Matt");
  CHECK(title_of(scene, {1, 0}) == "Sphere 1");
  CHECK(title_of(scene, {7}).empty());
  CHECK(users_of(scene, 1) == 1);
  scene.objects[0].name = "two\nlines\x1b";
  CHECK(title_of(scene, {0}) == "Two\\nlines\\u001b");
}

TEST_CASE("a ball around an object is where its transforms put it") {
  const Scene scene = example();
  const BoundingSphere glass = *bounding_sphere(scene, {1, 0}), media = *bounding_sphere(scene, {1, 1});
  CHECK(length(glass.center - Vec3d{0, 2, -1}) < 1e-12);
  CHECK(glass.radius == 0.5);
  CHECK(length(media.center - Vec3d{0.5, 2.5, -10.5}) < 1e-12);
  const BoundingSphere both = *bounding_sphere(scene, {1});
  for (const BoundingSphere& part : {glass, media})
    CHECK(length(part.center - both.center) + part.radius <= both.radius + 1e-12);
  CHECK_FALSE(bounding_sphere(scene, {9}));
}

TEST_CASE("at first the most interesting object is selected: metal, glass or fog, otherwise a lamp or a matt one") {
  Scene scene = example();
  CHECK(interesting(scene) == std::vector<ObjectPath>{{1, 0}, {1, 1}});
  scene.objects.resize(1);
  CHECK(interesting(scene) == std::vector<ObjectPath>{{0}});
  scene.objects.clear();
  CHECK(interesting(scene).empty());
}

TEST_CASE("outlines are tangents, and the outer edges of boxes; what is behind the eye is left out or cut") {
  double right = 0, top = 0, bottom = 0;
  for (const ImageLine& line : outline(example(), {0}))
    for (const ImagePoint& p : {line.a, line.b}) {
      right = std::max(right, p.x - 0.5);
      bottom = std::max(bottom, p.y - 0.5);
      top = std::max(top, 0.5 - p.y);
    }
  // Half of the outline's width, in heights of the picture.
  const double half = std::tan(std::asin(0.1)) / std::tan(std::acos(-1) / 6) / 2;
  CHECK(bottom == about(half, 1e-3));
  CHECK(top == about(half, 1e-3));
  CHECK(right == about(half / 2, 1e-3));
  Scene scene = seen({solid(Box<>{{-1, -1, -1}, {1, 1, 1}})});
  CHECK(outline(scene, {0}).size() == 4);
  scene.camera.look_from = {8, 7, 9};
  CHECK(outline(scene, {0}).size() == 6);
  scene = seen({ball("", {0, 0, 30}), solid(Quad<>{{-5, -1, -50}, {10, 0, 0}, {0, 0, 100}}), ball("", {0, 0, 10}, 5)});
  CHECK(outline(scene, {0}).empty());
  CHECK(outline(scene, {2}).empty());  // the eye is inside
  const std::vector<ImageLine> floor = outline(scene, {1});
  CHECK(floor.size() == 3);
  for (const ImageLine& line : floor)
    for (const ImagePoint& p : {line.a, line.b}) {
      CHECK(std::isfinite(p.x));
      CHECK(p.y > 0.5);
    }
}

TEST_CASE("fog is found where the ray enters it, nearest first, and not behind what hides it") {
  Scene scene =
      seen({fog(Sphere<>{{0, 0, 0}, 1, {}}), fog(Box<>{{-1, -1, -1}, {1, 1, 1}}, {RotateY{45}, Translate{{4, 0, 0}}})});
  CHECK(medium_at(scene, 0.5) == ObjectPath{0});
  CHECK(medium_at(scene, 0.5, 9.01) == ObjectPath{0});
  CHECK(medium_at(scene, 0.5, 8.99).empty());
  CHECK(objects_under(scene, {0.5, 0.05}).empty());
  // The box is 1.41 wide when turned: its corner is at x = 4 - 1.41.
  const double edge = 0.5 + (4 - 1.40) / (2 * 2 * 10 * std::tan(std::acos(-1) / 6));
  CHECK(medium_at(scene, edge + 0.005) == ObjectPath{1});
  CHECK(medium_at(scene, edge - 0.01).empty());
  scene.objects[1] = fog(Sphere<>{{0, 0, 5}, 1, {}});
  CHECK(medium_at(scene, 0.5) == ObjectPath{1});
  scene.objects[1] = fog(Sphere<>{{0, 0, 10}, 1, {}});
  CHECK(medium_at(scene, 0.5) == ObjectPath{0});
  scene.objects = {fog(Box<>{{2, -1, -1}, {4, 1, 1}}, {RotateY{90}})};  // now from z = -4 to -2
  CHECK(medium_at(scene, 0.5, 12.01) == ObjectPath{0});
  CHECK(medium_at(scene, 0.5, 11.99).empty());
}

TEST_CASE("all that lies under a point is listed from near to far, also in groups, and shapes only where they are") {
  Scene scene = seen({solid(Quad<>{{-2, -2, -3}, {4, 0, 0}, {0, 4, 0}}),
                      ball("", {0, 0, 0}),
                      {"turned", Group{{ball("", {-4, 0, 0}, 0.5)}}, {RotateY{90}}}});  // now at z = 4
  const auto found = objects_under(scene, {0.5, 0.5});
  REQUIRE(found.size() == 3);
  CHECK(found[0].path == ObjectPath{2, 0});
  CHECK(found[0].distance == doctest::Approx(5.5));
  CHECK(found[1].path == ObjectPath{1});
  CHECK(found[2].path == ObjectPath{0});
  CHECK(found[2].distance == doctest::Approx(13));
  CHECK(objects_under(scene, {0.95, 0.5}).empty());
  const auto found_at = [&](double xy) { return !objects_under(scene, *Projection(scene).point({xy, xy, 0})).empty(); };
  scene.objects = {solid(Triangle<>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})};
  CHECK(found_at(0.4));
  CHECK_FALSE(found_at(0.6));
  scene.objects = {solid(Disk<>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0.5})};
  CHECK(found_at(0.5));
  CHECK_FALSE(found_at(0.3));
  CHECK_FALSE(found_at(0.8));
}

TEST_CASE("what a projection shows at a point lies on the line of sight through it") {
  const Projection projection(example());
  const Vec3d point{1.5, -0.7, 2};
  const ViewRay view_ray = projection.view_ray(*projection.point(point));
  CHECK(length(cross(point - view_ray.origin, view_ray.direction)) < 1e-12);
  CHECK(projection.depth_of(point) == doctest::Approx(8));
  CHECK_FALSE(projection.point({0, 0, 11}));
}

}  // namespace tyndall::test::pointer_test
