#include "app/window/edit/arrange.h"
#include "tests/app/window/scenes.h"

#include <algorithm>
#include <memory>

namespace tyndall::test::arrange_test {

namespace {

const Box<> unit{{0, 0, 0}, {1, 1, 1}}, tall{{0, 0, 0}, {165, 330, 165}};

}  // namespace

TEST_CASE("moving changes the numbers that a person would change") {
  Scene scene = scene_of({solid(Sphere<>{{0, 1, 0}, 1, Vec3d{0, 1.5, 0}}),
                          solid(Box<>{{0.1, 0, 0}, {0.2, 1, 1}}),
                          solid(tall, {RotateY{15}, Translate{{265, 0, 295}}}),
                          solid(unit, {RotateY{15}}),
                          {"", Group{{solid(unit)}}, {}},
                          fog(unit, {Translate{{5, 0, 0}}})});
  set_anchor(scene, {0}, anchor_of(scene, {0}) + Vec3d{0.1, 0.2, 0});
  CHECK(shape(scene, 0) == Sphere<>{{0.1, 1.2, 0}, 1, Vec3d{0.1, 1.7, 0}});  // its centre, and where it moves to
  set_anchor(scene, {1}, {0.3, 0, 0});
  CHECK(shape<Box<>>(scene, 1) == Box<>{{0.3, 0, 0}, {0.4, 1, 1}});  // both corners, without the noise of sums
  CHECK(anchor_of(scene, {2}) == Vec3d{265, 0, 295});
  set_anchor(scene, {2}, {270, 0, 295});
  CHECK(scene.objects[2].transform == Transform{RotateY{15}, Translate{{270, 0, 295}}});  // the shift at the end
  CHECK(shape<Box<>>(scene, 2) == tall);
  set_anchor(scene, {3}, {1, 0, 0});
  CHECK(scene.objects[3].transform == Transform{RotateY{15}, Translate{{1, 0, 0}}});  // a new shift behind a turn
  set_anchor(scene, {4}, {0, 2, 0});
  CHECK(scene.objects[4].transform == Transform{Translate{{0, 2, 0}}});
  set_anchor(scene, {5}, {6, 0, 0});  // a medium's boundary, by its own transform
  CHECK(std::get<Volume>(scene.objects[5].kind).boundary_transform == Transform{Translate{{6, 0, 0}}});
  CHECK(scene.objects[5].transform.empty());
}

TEST_CASE("turning keeps the middle where it is, and puts a plain shape around the origin first") {
  Scene scene = scene_of({solid(Box<>{{1, 0, 2}, {3, 1, 6}})});
  const Vec3d middle = middle_of(scene, {0});
  struct Turn {
    double by, angle;
  };
  for (const auto& [by, angle] : {Turn{30, 30}, {340, 10}, {180, -170}, {170, 0}}) {
    rotate_object(scene, {0}, by);
    CHECK(angle_of(scene, {0}) == angle);
    CHECK(length(middle_of(scene, {0}) - middle) < 1e-12);
    CHECK(shape<Box<>>(scene) == Box<>{{-1, 0, -2}, {1, 1, 2}});
    if (by == 30) CHECK(scene.objects[0].transform == Transform{RotateY{30}, Translate{{2, 0, 4}}});
  }
  CHECK(scene.objects[0].transform == Transform{Translate{{2, 0, 4}}});
}

TEST_CASE("a shape that is not in the middle of its frame turns about its own middle, within groups, too") {
  Scene scene = scene_of({{"", Group{{solid(tall, {RotateY{15}, Translate{{265, 0, 295}}})}}, {RotateY{40}}}});
  struct Turn {
    ObjectPath path;
    double by, angle;
  };
  for (const auto& [path, by, angle] : {Turn{{0, 0}, 25, 40}, {{0}, 90, 130}}) {
    const Vec3d middle = middle_of(scene, path);
    rotate_object(scene, path, by);
    CHECK(angle_of(scene, path) == angle);
    CHECK(length(middle_of(scene, path) - middle) < 1e-3);
  }
}

TEST_CASE("grips: a sphere's radius, the ends of edges and half axes, a ring's hole; groups have none") {
  struct Row {
    decltype(Solid3d::shape) shape;
    std::size_t grips, grip;  ///< how many, and which is pulled
    Vec3d at;
    double value, wanted;
    decltype(Solid3d::shape) after;
  };
  const Vec3d o{0, 0, 0}, v{0, 2, 0}, slanted{3, 0, 4};
  const Disk<> ring{{0, 1, 0}, {2, 0, 0}, {0, 0, 1}, 0.5};
  for (const auto& [shape, grips, grip, at, value, wanted, after] :
       std::vector<Row>{{Sphere<>{{1, 2, 3}, -0.5, {}}, 1, 0, {1, 2.5, 3}, 0.5, 0.75, Sphere<>{{1, 2, 3}, -0.75, {}}},
                        {Sphere<>{{1, 2, 3}, -0.5, {}}, 1, 0, {1, 2.5, 3}, 0.5, -3, Sphere<>{{1, 2, 3}, -0.1, {}}},
                        {Quad<>{o, slanted, v}, 2, 0, {3, 1, 4}, 5, 10, Quad<>{o, {6, 0, 8}, v}},
                        {Triangle<>{o, slanted, v}, 2, 0, slanted, 5, 10, Triangle<>{o, {6, 0, 8}, v}},
                        {Triangle<>{o, slanted, v}, 2, 1, v, 2, 3, Triangle<>{o, slanted, {0, 3, 0}}},
                        {Disk<>{{0, 1, 0}, {2, 0, 0}, {0, 0, 1}, 0},
                         2,
                         1,
                         {0, 1, 1},
                         1,
                         1,
                         Disk<>{{0, 1, 0}, {2, 0, 0}, {0, 0, 1}, 0}},
                        {ring, 3, 0, {2, 1, 0}, 2, 4, Disk<>{{0, 1, 0}, {4, 0, 0}, {0, 0, 1}, 0.5}},
                        {ring, 3, 2, {-1, 1, 0}, 1, 0.5, Disk<>{{0, 1, 0}, {2, 0, 0}, {0, 0, 1}, 0.25}},
                        {ring, 3, 2, {-1, 1, 0}, 1, 100, Disk<>{{0, 1, 0}, {2, 0, 0}, {0, 0, 1}, 0.99}}}) {
    CAPTURE(shape.index());
    CAPTURE(grip);
    Scene scene = scene_of({solid(shape)});
    const auto found = size_grips(scene, {0}, {0, 1, 0});
    REQUIRE(found.size() == grips);
    CHECK(found[grip].at == at);
    CHECK(found[grip].value == value);
    set_size(scene, {0}, grip, wanted, 0.1);
    CHECK(std::get<Solid3d>(scene.objects[0].kind).shape == after);
  }
  const Scene group = scene_of({{"", Group{}, {}}});
  for (const int object : {0, 3}) CHECK(size_grips(group, {object}, {0, 1, 0}).empty());
}

TEST_CASE("a box's grips are its faces, turned with it; the face opposite stays") {
  const Scene scene = scene_of({solid(Box<>{{0, 0, 0}, {2, 1, 1}}, {RotateY{90}, Translate{{0, 5, 0}}})});
  const auto grips = size_grips(scene, {0}, {0, 1, 0});
  REQUIRE(grips.size() == 6);
  CHECK(length(grips[0].pull - Vec3d{0, 0, -1}) < 1e-12);
  CHECK(length(grips[0].at - Vec3d{0.5, 5.5, -2}) < 1e-12);
  for (std::size_t k = 0; k < 6; ++k) {
    Scene larger = scene;
    set_size(larger, {0}, k, grips[k].value + 1, 0.1);
    CHECK(size_grips(larger, {0}, {0, 1, 0})[k].value == grips[k].value + 1);
    CHECK(size_grips(larger, {0}, {0, 1, 0})[k ^ 1].value == grips[k ^ 1].value);
    set_size(larger, {0}, k, -100, 0.1);  // beyond the other face
    const Vec3d edges = shape<Box<>>(larger).max - shape<Box<>>(larger).min;
    CHECK(std::min({edges.x, edges.y, edges.z}) == doctest::Approx(0.1));
  }
}

namespace {

const Sphere<>& medium_sphere(const Scene& scene, std::size_t k) {
  return std::get<Sphere<>>(std::get<Volume>(scene.objects[k].kind).boundary);
}

/// A shell of glass with media in it, a sphere of grey around the same centre, and another one elsewhere.
Scene shell() {
  const Vec3d center{0.1, 1, 0};
  return scene_of({ball("", center, 1, 1), ball("", center, -0.9, 1), fog(Sphere<>{center, 1, {}}),
                   ball("", center, 0.3, 0), ball("", {5, 1, 0}, 0.3, 1)});
}

}  // namespace

TEST_CASE("a ball of glass has the fog that fills it and the spheres within as companions, a matt one only the fog") {
  Scene scene = shell();
  CHECK(linked_objects(scene, {0}) == std::vector<ObjectPath>{{1}, {2}, {3}});
  CHECK(linked_objects(scene, {1}) == std::vector<ObjectPath>{{3}});
  CHECK(linked_objects(scene, {2}).empty());
  CHECK(linked_objects(scene, {4}).empty());
  std::get<Solid3d>(scene.objects[0].kind).material = 0;
  CHECK(linked_objects(scene, {0}) == std::vector<ObjectPath>{{2}});
}

TEST_CASE("companions follow exactly: the same centre, fog the very numbers, inner spheres the proportion") {
  const Scene before = shell();
  Scene after = before;
  shape(after, 0) = {{0.4, 1.2, -1}, 2, {}};
  move_linked_objects(before, before, after);
  CHECK(shape(after, 1) == Sphere<>{{0.4, 1.2, -1}, -1.8, {}});
  CHECK(medium_sphere(after, 2) == shape(after, 0));
  CHECK(shape(after, 3) == Sphere<>{{0.4, 1.2, -1}, 0.6, {}});
  CHECK(after.objects[4] == before.objects[4]);
  Scene inner = before;
  shape(inner, 1).radius = -0.5;
  move_linked_objects(before, before, inner);
  CHECK(inner.objects[0] == before.objects[0]);
  CHECK(shape(inner, 1).radius == -0.5);
}

TEST_CASE("fog in a box takes over the box's turn") {
  const Box<> box{{0, 0, 0}, {1, 2, 1}};
  const Scene before = scene_of({solid(box), fog(box)});
  Scene after = before;
  rotate_object(after, {0}, 30);
  move_linked_objects(before, before, after);
  CHECK(placement_at(after, {1}) == placement_at(after, {0}));
  CHECK(linked_objects(after, {0}) == std::vector<ObjectPath>{{1}});
}

TEST_CASE("nothing adds up over the drawings of a drag: the companions follow from where it began") {
  const Scene before = shell();
  Scene now = before;
  GestureStart start;
  for (int k = 1000; k >= 0; --k) {
    Scene next = now;
    shape(next, 0).radius = 1 + 0.003 * k / 7;
    start.finish_edit(std::make_shared<const Scene>(now), next, 5);
    now = next;
  }
  CHECK(now == before);
}

}  // namespace tyndall::test::arrange_test
