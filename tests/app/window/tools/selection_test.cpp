#include "app/window/tools/selection.h"
#include "app/window/tools/projection.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

namespace tyndall::test::selection_test {

namespace {

Object ball(Vec3d center, double radius, int material, const std::string& name = "") {
  return {name, Solid3d{Sphere<>{center, radius, {}}, material}, {}};
}

/// A matt sphere, and a group, turned and moved, of a glass sphere and a box of media.
Scene example() {
  Scene scene;
  scene.width = 200, scene.height = 100;
  scene.camera.look_from = {0, 0, 10};
  scene.camera.vfov = 60;
  scene.materials = {{"grey", Vec3d{0.5, 0.5, 0.5}, Lambertian<>{}}, {"glass", {}, Dielectric<>{}}};
  Object fog{"", Volume{Box<>{{0, 0, 0}, {1, 1, 1}}, {Translate{{10, 0, 0}}}, {}, {}}, {}};
  scene.objects = {ball({0, 0, 0}, 1, 0, "matt"),
                   {"pair", Group{{ball({1, 0, 0}, 0.5, 1), fog}}, {RotateY{90}, Translate{{0, 2, 0}}}}};
  return scene;
}

/// The medium that a line of sight enters first, if it does so before `depth` along the axis; empty: none.
ObjectPath medium_at(const Scene& scene, ImagePoint at, double depth) {
  for (const ObjectUnder& object : objects_under(scene, at))
    if (object.medium && object.distance * Projection(scene).view_ray(at).direction.z * -1 < depth) return object.path;
  return {};
}

struct Span {
  double x0 = 1e9, x1 = -1e9, y0 = 1e9, y1 = -1e9;
};
Span extent(const std::vector<ImageLine>& lines) {
  Span e;
  for (const ImageLine& line : lines)
    for (const ImagePoint& p : {line.a, line.b}) {
      e.x0 = std::min(e.x0, p.x), e.x1 = std::max(e.x1, p.x);
      e.y0 = std::min(e.y0, p.y), e.y1 = std::max(e.y1, p.y);
    }
  return e;
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
  Scene odd = scene;
  odd.objects[0].name = "two\nlines\x1b";
  CHECK(title_of(odd, {0}) == "Two\\nlines\\u001b");
  CHECK(users_of(scene, 1) == 1);
}

TEST_CASE("a ball around an object is where its transforms put it") {
  const Scene scene = example();
  const BoundingSphere glass = *bounding_sphere(scene, {1, 0});
  CHECK(length(glass.center - Vec3d{0, 2, -1}) < 1e-12);
  CHECK(glass.radius == 0.5);
  const BoundingSphere fog = *bounding_sphere(scene, {1, 1});
  CHECK(length(fog.center - Vec3d{0.5, 2.5, -10.5}) < 1e-12);
  const BoundingSphere both = *bounding_sphere(scene, {1});
  for (const BoundingSphere& part : {glass, fog})
    CHECK(length(part.center - both.center) + part.radius <= both.radius + 1e-12);
  CHECK_FALSE(bounding_sphere(scene, {9}).has_value());
}

TEST_CASE("at first the most interesting object is selected: metal, glass or fog, otherwise a lamp or a matt one") {
  Scene scene = example();
  CHECK(interesting(scene) == std::vector<ObjectPath>{{1, 0}, {1, 1}});
  scene.objects.resize(1);
  CHECK(interesting(scene) == std::vector<ObjectPath>{{0}});
  scene.objects.clear();
  CHECK(interesting(scene).empty());
}

TEST_CASE("a sphere's outline is the circle of its tangents") {
  const Span e = extent(outline(example(), {0}));
  // Half of the outline's width, in heights of the picture.
  const double half = std::tan(std::asin(0.1)) / std::tan(std::acos(-1) / 6) / 2;
  CHECK(e.y1 - 0.5 == doctest::Approx(half).epsilon(1e-3).scale(0));
  CHECK(0.5 - e.y0 == doctest::Approx(half).epsilon(1e-3).scale(0));
  CHECK(e.x1 - 0.5 == doctest::Approx(half / 2).epsilon(1e-3).scale(0));
}

TEST_CASE("a box seen face on has four edges, from a corner six") {
  Scene scene = example();
  scene.objects = {{"box", Solid3d{Box<>{{-1, -1, -1}, {1, 1, 1}}, 0}, {}}};
  CHECK(outline(scene, {0}).size() == 4);
  scene.camera.look_from = {8, 7, 9};
  CHECK(outline(scene, {0}).size() == 6);
}

TEST_CASE("what is behind the eye is left out, what reaches behind it is cut") {
  Scene scene = example();
  scene.objects = {ball({0, 0, 30}, 1, 0),
                   {"floor", Solid3d{Quad<>{{-5, -1, -50}, {10, 0, 0}, {0, 0, 100}}, 0}, {}},
                   ball({0, 0, 10}, 5, 0)};
  CHECK(outline(scene, {0}).empty());
  const std::vector<ImageLine> floor = outline(scene, {1});
  CHECK(floor.size() == 3);
  for (const ImageLine& line : floor)
    for (const ImagePoint& p : {line.a, line.b}) {
      CHECK(std::isfinite(p.x));
      CHECK(p.y > 0.5);
    }
  CHECK(outline(scene, {2}).empty());  // the eye is inside
}

TEST_CASE("fog is found where the ray enters it, nearest first, and not behind what hides it") {
  Scene scene = example();
  const auto fog = [](std::variant<Sphere<>, Box<>> boundary, Transform transform) {
    return Object{"", Volume{boundary, std::move(transform), {}, {}}, {}};
  };
  scene.objects = {fog(Sphere<>{{0, 0, 0}, 1, {}}, {}),
                   fog(Box<>{{-1, -1, -1}, {1, 1, 1}}, {RotateY{45}, Translate{{4, 0, 0}}})};
  const double infinite = std::numeric_limits<double>::infinity();
  CHECK(medium_at(scene, {0.5, 0.5}, infinite) == ObjectPath{0});
  CHECK(medium_at(scene, {0.5, 0.5}, 9.01) == ObjectPath{0});
  CHECK(medium_at(scene, {0.5, 0.5}, 8.99).empty());
  CHECK(medium_at(scene, {0.5, 0.05}, infinite).empty());
  // The box is 1.41 wide when turned: its corner is at x = 4 - 1.41.
  const double edge = 0.5 + (4 - 1.40) / (2 * 2 * 10 * std::tan(std::acos(-1) / 6)), beyond = edge - 0.01;
  CHECK(medium_at(scene, {edge + 0.005, 0.5}, infinite) == ObjectPath{1});
  CHECK(medium_at(scene, {beyond, 0.5}, infinite).empty());
  scene.objects[1] = fog(Sphere<>{{0, 0, 5}, 1, {}}, {});
  CHECK(medium_at(scene, {0.5, 0.5}, infinite) == ObjectPath{1});
  scene.objects[1] = fog(Sphere<>{{0, 0, 10}, 1, {}}, {});
  CHECK(medium_at(scene, {0.5, 0.5}, infinite) == ObjectPath{0});
  scene.objects = {fog(Box<>{{2, -1, -1}, {4, 1, 1}}, {RotateY{90}})};  // now from z = -4 to -2
  CHECK(medium_at(scene, {0.5, 0.5}, 12.01) == ObjectPath{0});
  CHECK(medium_at(scene, {0.5, 0.5}, 11.99).empty());
}

TEST_CASE(
    "all that lies under a point is listed from near to far, also in turned groups, and quads only within their "
    "edges") {
  Scene scene = example();
  scene.objects = {{"wall", Solid3d{Quad<>{{-2, -2, -3}, {4, 0, 0}, {0, 4, 0}}, 0}, {}},
                   ball({0, 0, 0}, 1, 0),
                   {"turned", Group{{ball({-4, 0, 0}, 0.5, 1)}}, {RotateY{90}}}};  // now at z = 4
  const auto found = objects_under(scene, {0.5, 0.5});
  REQUIRE(found.size() == 3);
  CHECK(found[0].path == ObjectPath{2, 0});
  CHECK(found[0].distance == doctest::Approx(5.5));
  CHECK(found[1].path == ObjectPath{1});
  CHECK(found[2].path == ObjectPath{0});
  CHECK(found[2].distance == doctest::Approx(13));
  CHECK(objects_under(scene, {0.95, 0.5}).empty());
}

TEST_CASE("a triangle and a ring are found only where they are") {
  Scene scene = example();
  const auto found_at = [&](double x, double y) {
    return !objects_under(scene, *Projection(scene).point({x, y, 0})).empty();
  };
  scene.objects = {{"sail", Solid3d{Triangle<>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 0}, {}}};
  CHECK(found_at(0.4, 0.4));
  CHECK_FALSE(found_at(0.6, 0.6));
  scene.objects = {{"ring", Solid3d{Disk<>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0.5}, 0}, {}}};
  CHECK(found_at(0.5, 0.5));
  CHECK_FALSE(found_at(0.3, 0.3));
  CHECK_FALSE(found_at(0.8, 0.8));
}

TEST_CASE("what a projection shows at a point lies on the line of sight through it") {
  const Projection projection(example());
  const Vec3d point{1.5, -0.7, 2};
  const ViewRay view_ray = projection.view_ray(*projection.point(point));
  CHECK(length(cross(point - view_ray.origin, view_ray.direction)) < 1e-12);
  CHECK(projection.depth_of(point) == doctest::Approx(8));
  CHECK_FALSE(projection.point({0, 0, 11}).has_value());
}

}  // namespace tyndall::test::selection_test
