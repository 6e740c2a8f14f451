#include "tests/support/probe.h"

#include <doctest/doctest.h>

#include <functional>

/// Lights found by exact specular paths: off and through spheres, off flat mirrors, through slabs. The light is what
/// scattering alone finds in the end. Known answers are cases of "tyndall verify".
namespace tyndall::test::specular_paths_test {

namespace {

using Change = std::function<void(Scene&)>;

/// A point of a floor under a light, and what brings it light by specular paths.
struct Row {
  std::string name;
  double light_radius;
  Vec3d light_center, point;
  double less_noise;  ///< than scattering has
  Change change;
};

/// The same point by specular paths and by scattering alone: equal, and with less noise.
void check_against_scattering(const Row& row) {
  CAPTURE(row.name);
  Scene scene = lit_floor(row.light_radius, row.light_center, 20);
  row.change(scene);
  const double open = scene.camera.shutter_open, close = scene.camera.shutter_close;
  aim(scene, {0.3, 4, 6}, row.point);
  scene.camera.shutter_open = open, scene.camera.shutter_close = close;
  REQUIRE(compile(scene).specular.sphere.size() > 0);
  const Estimate by_specular_paths = radiance(scene, 64);
  scene.render.caustics = Caustics::scatter;
  REQUIRE(compile(scene).specular.sphere.empty());
  const Estimate chance = radiance(scene, 1024);
  check_agree(by_specular_paths, chance);
  CHECK(by_specular_paths.error < row.less_noise * chance.error * 4);  // sixteen times fewer samples
}

void open_shutter(Scene& s) { s.camera.shutter_open = 0.2, s.camera.shutter_close = 0.9; }

template <class Shape>
Change with(const Shape& shape, const Material& material, const Transform& transform = {}) {
  return [=](Scene& s) { add(s, shape, material, transform); };
}

const Vec3d above{1.5, 4.5, 0.5}, center{0, 1.2, 0}, within{0.2, 1.3, 0.1};
const Sphere<> ball = sphere(center, 1);
const Material silver = metal(0.9, 0);

Change shell(double inner, Vec3d way = {}) {
  return [=](Scene& s) {
    for (const double radius : {1.0, -inner}) add(s, Sphere<>{center, radius, center + way}, glass(1.5));
    open_shutter(s);
  };
}

Change all_of(const Change& first, const Change& second) {
  return [=](Scene& s) { first(s), second(s); };
}

template <class Boundary>
Change fog(const Boundary& boundary, Medium<> medium) {
  return [=](Scene& s) { add_medium(s, boundary, medium, 0.9); };
}

/// The floor's lamp with tiles of three colours.
void tile_lamp(Scene& s) {
  s.textures.push_back({"tiles", Checker<>{0.1, {5, 20, 30}, {20, 10, 5}}});
  s.materials[1].colour = TextureIndex{0};
}

/// Another shape as the floor's lamp.
template <class Shape>
Change lamp_of(const Shape& shape) {
  return [=](Scene& s) { std::get<Solid3d>(s.objects[1].kind).shape = shape; };
}

}  // namespace

TEST_CASE("specular paths: what scattering finds, with less noise, off and through spheres and out of bulbs") {
  const Quad<> pane_lamp{{1.3, 4.5, 0.3}, {0.4, 0, 0}, {0, 0.1, 0.4}};
  const Row rows[] = {
      {"mirror", 0.3, above, {1.6, 0, 1}, 0.3, with(ball, silver)},
      {"glass", 0.3, above, {-0.6, 0, 0.5}, 0.5, with(ball, glass(1.5))},
      {"air in glass", 0.1, above, {-0.6, 0, 0.5}, 0.5, with(ball, glass(0.75))},
      {"shell", 0.3, above, {-0.5, 0, 0.6}, 0.5, shell(0.85)},
      {"thick shell", 0.3, above, {-0.5, 0, 0.6}, 1, shell(0.5)},
      {"moving shell", 0.3, above, {-0.5, 0, 0.6}, 0.5, shell(0.85, {0.1, 0.1, 0.1})},
      {"moving mirror",
       0.3,
       above,
       {1.6, 0, 1},
       0.5,
       all_of(with(Sphere<>{center, 1, center + Vec3d{0.1, 0.1, 0.1}}, silver), open_shutter)},
      {"bulb", 0.2, within, {1, 0, 1.5}, 0.5, shell(0.85)},
      {"moving bulb", 0.1, within, {1, 0, 1.5}, 0.5, shell(0.85, {0.1, 0.1, 0})},
      {"lamp in glass", 0.2, within, {1, 0, 1.5}, 0.5, with(ball, glass(1.5))},
      {"sunk", 0.3, above, {-1.2, 0, 0.2}, 1, with(sphere({0, 0.6, 0}, 1), glass(1.5))},
      {"fog in the ball", 0.3, above, {-0.6, 0, 0.5}, 1, all_of(with(ball, glass(1.5)), fog(ball, {0.5, 0.3}))},
      {"tiled lamp", 0.3, above, {1.6, 0, 1}, 0.3, all_of(with(ball, silver), tile_lamp)},
      {"quad as lamp", 0.3, above, {1.6, 0, 1}, 0.3, all_of(with(ball, silver), lamp_of(pane_lamp))},
      {"box as lamp",
       0.3,
       above,
       {1.6, 0, 1},
       0.5,
       all_of(with(ball, silver), lamp_of(Box<>{{1.3, 4.3, 0.3}, {1.7, 4.7, 0.7}}))},
  };
  for (const Row& row : rows) check_against_scattering(row);
}

TEST_CASE("specular paths: what scattering finds, with less noise, off flat mirrors, from both sides") {
  const Vec3d hanging{1.5, 3, -2}, point{0.5, 0, 1};
  const Quad<> wall{{-6, 0, -4}, {12, 0, 0}, {0, 8, 0}};
  const Row rows[] = {
      {"parallelogram", 0.3, hanging, point, 0.25, with(Quad<>{{-6, 0, -4}, {12, 0, 0}, {4, 8, 0}}, silver)},
      {"back of a quad", 0.3, hanging, point, 0.25, with(Quad<>{{-6, 0, -4}, {0, 8, 0}, {12, 0, 0}}, silver)},
      {"turned block",
       0.3,
       hanging,
       {0.55, 0, -1.05},
       0.5,
       with(Box<>{{-1, 0, -1}, {1, 3, 1}}, silver, {RotateY{30}, Translate{{-1.5, 0, 0}}})},
      {"room of metal", 0.3, hanging, point, 1,
       [](Scene& s) {
         s.render.max_depth = 200;
         add(s, Box<>{{-5, -0.1, -4}, {5, 6, 7}}, metal(0.4, 0));
       }},
      {"tiles", 0.3, hanging, point, 0.25,
       [&](Scene& s) {
         s.textures.push_back({"tiles", Checker<>{0.7, {0.1, 0.5, 1}, {0.9, 0.7, 0.2}}});
         add(s, wall, {"", TextureIndex{0}, Metal<>{0}});
       }},
      {"three lamps and two mirrors", 0.3, hanging, point, 0.5,
       [&](Scene& s) {
         add(s, Sphere<>{{-1, 2, -2}, 0.2, Vec3d{0, 2.5, -2}}, lamp(20));
         add(s, Quad<>{{0, 3.5, -1}, {0.4, 0, 0}, {0.1, 0.1, 0.4}}, lamp(20));
         add(s, wall, silver);
         add(s, Quad<>{{4, 0, -4}, {0, 0, 6}, {1, 5, 0}}, metal(0.7, 0));
         s.camera.shutter_open = 0, s.camera.shutter_close = 1;
       }},
      {"beside a ball of glass", 0.3, hanging, point, 1,
       all_of(with(wall, silver), with(sphere({0.7, 1, 0}, 0.8), glass(1.5)))},
      {"fog", 0.3, hanging, point, 1, all_of(with(wall, silver), fog(Box<>{{-3, 0, -5}, {3, 4, 3}}, {0.1, 0.4}))},
  };
  for (const Row& row : rows) check_against_scattering(row);
}

TEST_CASE("specular paths: what scattering finds, with less noise, through slabs and cubes, and reflected in them") {
  const Vec3d hanging{0.5, 1.5, -3}, point{0.5, 0, 1};
  const Box<> upright{{-2, 0.01, -1.1}, {3, 3, -0.9}};
  const Change pane = with(upright, glass(1.5));
  const Transform turned{RotateY{25}, Translate{{0.4, 0, -0.4}}};
  const Row rows[] = {
      {"pane", 0.3, hanging, point, 0.25, pane},
      {"pane, on the lamp's side", 0.3, hanging, {0.5, 0, -2}, 1, pane},
      {"pane, at its narrow side", 0.3, hanging, {3.3, 0, 0.4}, 0.5, pane},
      {"turned cube",
       0.3,
       hanging,
       {0.4, 0, 0.9},
       0.5,
       with(Box<>{{-0.5, 0.1, -0.5}, {0.5, 1.1, 0.5}}, glass(1.5), turned)},
      {"cube on the floor",
       0.3,
       hanging,
       {0.4, 0, 0.9},
       0.5,
       with(Box<>{{-0.5, 0, -0.5}, {0.5, 1, 0.5}}, glass(2), turned)},
      {"three lamps, a mirror, two panes", 0.3, hanging, point, 1,
       [&](Scene& s) {
         add(s, Sphere<>{{-1, 2, -3}, 0.2, Vec3d{0, 2.5, -3}}, lamp(20));
         add(s, Quad<>{{0, 3.5, -2}, {0.4, 0, 0}, {0.1, 0.1, 0.4}}, lamp(20));
         add(s, upright, glass(1.5));
         add(s, Box<>{{-1.5, 0.2, -0.3}, {-0.5, 2, -0.1}}, glass(1.6), {RotateY{10}});
         add(s, Quad<>{{4, 0, -4}, {0, 0, 6}, {1, 5, 0}}, metal(0.7, 0));
         s.camera.shutter_open = 0, s.camera.shutter_close = 1;
       }},
      {"fog", 0.3, hanging, point, 1, all_of(pane, fog(Box<>{{-4, 0, -5}, {4, 4, 3}}, {0.1, 0.4}))},
      {"fog within", 0.3, hanging, point, 1, all_of(pane, fog(upright, {2, 0.4}))},
  };
  for (const Row& row : rows) check_against_scattering(row);
}

TEST_CASE("specular paths: in a white furnace mirrors, shells, bulbs and slabs are invisible") {
  const auto check = [](std::size_t spheres, std::size_t flats, const Change& change) {
    Scene scene = white_room();
    scene.render.integrator = Integrator::mis;
    scene.camera = {.look_from = {0, 3, 7}, .look_at = {0, 1, 0}, .vfov = 40};
    add(scene, Quad<>{{-6, 0, -6}, {12, 0, 0}, {0, 0, 12}}, lambertian(1));
    add(scene, sphere(above, 0.1), lamp(1));
    change(scene);
    CHECK(compile(scene).specular.sphere.size() >= spheres);
    CHECK(compile(scene).specular.flats.size() >= flats);
    const Estimate all = radiance(scene, 256);
    CHECK(std::abs(all.mean - 1) < 4 * all.error);
    CHECK(all.error < 0.002);
  };
  check(4, 0, [](Scene& s) {
    add(s, sphere({-1.2, 1.2, 0}, 1), metal(1, 0));
    add(s, sphere({1.2, 1.2, 0}, 1), glass(1.5));
    add(s, sphere({1.2, 1.2, 0}, -0.8), glass(1.5));
    add(s, sphere({1.3, 1.3, 0}, 0.1), lamp(1));
  });
  check(2, 2, [](Scene& s) {
    add(s, Box<>{{-2, 0.5, -1}, {-1, 1.5, 0}}, metal(1, 0), {RotateY{20}});
    add(s, Quad<>{{-1, 0, 1}, {2.5, 0, 0}, {0, 2, 0.2}}, metal(1, 0));
  });
  check(2, 2, [](Scene& s) {
    add(s, Box<>{{-2, 0.5, -1}, {-1, 1.5, 0}}, glass(1.5), {RotateY{20}});
    add(s, Box<>{{-1, 0, 1}, {1.5, 2, 1.2}}, glass(1.7));
    // Light that the floor scatters nearly level into the second slab, which stands on it, is kept in there for long:
    // of two million paths three have more than the usual 1000 events, none more than 4000.
    s.render.max_depth = 10000;
  });
}

}  // namespace tyndall::test::specular_paths_test
