#include "core/compile/flatten.h"

#include "tests/support/mixed_scene.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

namespace tyndall::test::flatten_test {

namespace {

Transform some_transform(Engine& engine) {
  Transform list;
  for (int i = static_cast<int>(engine() % 4); i > 0; --i) {
    if (engine() % 2)
      list.push_back(RotateY{uniform(engine, -400, 400)});
    else
      list.push_back(Translate{in_cube(engine, 10)});
  }
  return list;
}

/// One step after the other, by the scene file's definition.
Vec3d by_steps(const Transform& list, Vec3d p) {
  for (const auto& step : list) {
    if (const auto* move = std::get_if<Translate>(&step)) {
      p = p + move->offset;
    } else {
      const double a = std::get<RotateY>(step).degrees * 3.14159265358979323846 / 180;
      p = {std::cos(a) * p.x + std::sin(a) * p.z, p.y, std::cos(a) * p.z - std::sin(a) * p.x};
    }
  }
  return p;
}

bool near(Vec3d a, Vec3d b) { return length(a - b) < 1e-12 * (1 + length(b)); }

Object sphere_at(Vec3d center, Transform transform = {}) {
  return {"", Solid3d{Sphere<>{center, 1, {}}, 0}, std::move(transform)};
}

Object fog(std::variant<Sphere<>, Box<>> boundary, Transform inner = {}, Transform outer = {}) {
  return {"", Volume{boundary, std::move(inner), {1, 0}, Vec3d{1, 1, 1}}, std::move(outer)};
}

}  // namespace

TEST_CASE("transforms: the list in its order; rotate_y in the books' sense") {
  const Vec3d x{1, 0, 0};
  CHECK(place(placement_of({RotateY{90}}), x) == Vec3d{0, 0, -1});
  CHECK(place(placement_of({RotateY{90}}), {0, 5, 1}) == Vec3d{1, 5, 0});
  CHECK(place(placement_of({RotateY{90}, Translate{x}}), x) == Vec3d{1, 0, -1});
  CHECK(place(placement_of({Translate{x}, RotateY{90}}), x) == Vec3d{0, 0, -2});
  CHECK(rotate(placement_of({Translate{x}, RotateY{90}}), x) == Vec3d{0, 0, -1});
  CHECK(place(placement_of({}), x) == x);
}

TEST_CASE("transforms: quarter turns are exact, whole turns nothing") {
  const Vec3d p{3, 4, 5};
  for (const double revolutions : {-2.0, -1.0, 0.0, 1.0, 7.0}) {
    CHECK(place({360 * revolutions, {}}, p) == p);
    CHECK(place({360 * revolutions + 90, {}}, p) == Vec3d{5, 4, -3});
    CHECK(place({360 * revolutions + 180, {}}, p) == Vec3d{-3, 4, -5});
    CHECK(place({360 * revolutions - 90, {}}, p) == Vec3d{-5, 4, 3});
  }
}

TEST_CASE("transforms: composed, they do what their steps do one after the other") {
  Engine engine(1);
  for (int i = 0; i < 1000; ++i) {
    const Transform first = some_transform(engine), second = some_transform(engine);
    const Vec3d p = in_cube(engine, 10);
    CHECK(near(place(placement_of(first), p), by_steps(first, p)));
    CHECK(near(place(compose(placement_of(second), placement_of(first)), p), by_steps(second, by_steps(first, p))));
  }
}

TEST_CASE("flatten: an object's own transform, then those of its groups from inside out") {
  Engine engine(2);
  for (int i = 0; i < 100; ++i) {
    const Transform own = some_transform(engine), inner = some_transform(engine), outer = some_transform(engine);
    const Vec3d p = in_cube(engine, 10);
    Scene scene;
    scene.objects = {{"", Group{{sphere_at({}), {"", Group{{sphere_at(p, own)}}, inner}}}, outer}};
    const Flattened flat = flatten(scene);
    REQUIRE(flat.shapes.size() == 2);
    CHECK(near(center_of(flat.shapes[0]), by_steps(outer, {})));
    CHECK(near(center_of(flat.shapes[1]), by_steps(outer, by_steps(inner, by_steps(own, p)))));
  }
}

TEST_CASE("flatten: shapes keep the order of the file and know which object they are") {
  Scene scene;
  scene.objects = {sphere_at({1, 0, 0}),
                   {"", Group{{sphere_at({2, 0, 0}), {"", Group{{sphere_at({3, 0, 0})}}, {}}}}, {}},
                   fog(Sphere<>{{0, 0, 0}, 1, {}}),
                   {"", Group{}, {}},
                   sphere_at({4, 0, 0})};
  const Flattened flat = flatten(scene);
  REQUIRE(flat.shapes.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) CHECK(center_of(flat.shapes[i]).x == static_cast<double>(i + 1));
  CHECK(flat.objects.path(flat.shapes[0].object) == std::vector<int>{0});
  CHECK(flat.objects.path(flat.shapes[1].object) == std::vector<int>{1, 0});
  CHECK(flat.objects.path(flat.shapes[2].object) == std::vector<int>{1, 1, 0});
  CHECK(flat.objects.path(flat.shapes[3].object) == std::vector<int>{4});
  CHECK(flat.volumes.size() == 1);
}

TEST_CASE("flatten: of shapes in exactly one place the first is kept, however its placement is written") {
  Scene scene;
  const Quad<> quad{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const auto solid = [](auto shape, int material, Transform transform = {}) {
    return Object{"", Solid3d{shape, material}, std::move(transform)};
  };
  scene.objects = {sphere_at({1, 0, 0}),
                   solid(quad, 3, {Translate{{1, 2, 3}}}),
                   sphere_at({1, -0.0, 0}),
                   solid(Box<>{}, 0),
                   {"", Group{{solid(quad, 4), solid(Box<>{}, 5, {RotateY{1}})}}, {Translate{{1, 2, 3}}}},
                   solid(Sphere<>{{1, 0, 0}, 1, Vec3d{1, 0, 0}}, 6),
                   solid(Sphere<>{{1, 0, 0}, 1 + 1e-15, {}}, 7)};
  const Flattened flat = flatten(scene);
  REQUIRE(flat.shapes.size() == 6);
  CHECK(flat.shapes[1].material == 3);
  CHECK(flat.objects.path(flat.shapes[3].object) == std::vector<int>{4, 1});
  CHECK(flat.shapes[4].material == 6);  // one that may move is another
  CHECK(flat.shapes[5].material == 7);
}

TEST_CASE("flatten: a medium's boundary has its own transform, then the object's") {
  Scene scene;
  const Box<> box{{0, 0, 0}, {2, 2, 2}};
  scene.objects = {fog(box, {RotateY{90}}, {Translate{{10, 0, 0}}})};
  const Flattened flat = flatten(scene);
  REQUIRE(flat.volumes.size() == 1);
  CHECK(near(center_of(flat.volumes[0]), {11, 1, -1}));
}

TEST_CASE("flatten: a medium of density 0 is none") {
  Scene scene;
  scene.objects = {fog(Box<>{})};
  std::get<Volume>(scene.objects[0].kind).medium.density = 0;
  CHECK(flatten(scene).volumes.empty());
}

TEST_CASE("flatten: a medium whose boundary is exactly a shape's is that shape's interior") {
  const Transform move{RotateY{30}, Translate{{1, 2, 3}}};
  const Box<> box{{0, 0, 0}, {1, 2, 3}};
  const Sphere<> ball{{1, 1, 1}, 0.5, {}};
  const Object solid_box{"", Solid3d{box, 0}, move}, solid_sphere{"", Solid3d{ball, 0}, {}};
  const auto surface_of = [](const Scene& scene) { return flatten(scene).volumes.at(0).surface; };
  Scene scene;
  scene.objects = {solid_sphere, solid_box, fog(box, {}, move)};
  CHECK(surface_of(scene) == 1);
  // However the same placement is written: on the boundary, on the object, on a group around it.
  scene.objects = {solid_box, fog(box, move)};
  CHECK(surface_of(scene) == 0);
  scene.objects = {fog(box, {RotateY{30}}, {Translate{{1, 2, 3}}}), solid_box};
  CHECK(surface_of(scene) == 0);
  scene.objects = {{"", Group{{fog(ball), solid_sphere}}, {Translate{{5, 0, 0}}}}};
  CHECK(surface_of(scene) == 0);
  // Another size, place, turn or kind is another shape.
  for (const Object& other :
       {fog(Box<>{{0, 0, 0}, {1, 2, 3.0000001}}, move), fog(box, {RotateY{30}}),
        fog(box, {RotateY{31}, Translate{{1, 2, 3}}}), fog(Sphere<>{{0.5, 1, 1.5}, 1, {}}, move)}) {
    scene.objects = {solid_box, other};
    CHECK_FALSE(surface_of(scene));
  }
  // A bubble's sphere has its normal inward: it is not the boundary's shape.
  scene.objects = {{"", Solid3d{Sphere<>{{1, 1, 1}, -0.5, {}}, 0}, {}}, fog(ball)};
  CHECK_FALSE(surface_of(scene));
}

}  // namespace tyndall::test::flatten_test
