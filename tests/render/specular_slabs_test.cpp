#include "tests/support/lit_floor.h"

#include <doctest/doctest.h>

#include <cmath>

/// Lights found by exact specular paths through slabs: the light is what scattering alone finds in the end.
namespace tyndall::test::specular_slabs_test {

namespace {

const Vec3d hanging{0.5, 1.5, -3};
const Box<> upright{{-2, 0.01, -1.1}, {3, 3, -0.9}};

Scene floor_with(double light_radius, auto change) {
  Scene scene = lit_floor(light_radius, hanging, 20);
  change(scene);
  return scene;
}

void check_floor(const std::string& name, Vec3d point, double less_noise, auto change) {
  Scene scene = floor_with(0.3, change);
  REQUIRE(compile(scene).specular.flats.size() > 0);
  check_point_of_floor(name, scene, point, less_noise);
}

}  // namespace

TEST_CASE("specular paths: a light seen straight through a slab") {
  const double radius = 0.01, strength = 1e5, thick = 0.5, index = 1.5;
  Scene scene = dark_room();
  scene.render.integrator = Integrator::mis;
  add(scene, Quad<>{{-6, 0, -6}, {12, 0, 0}, {0, 0, 12}}, lambertian(0.73));
  add(scene, sphere({0, 3, 0}, radius), lamp(strength));
  add(scene, Box<>{{-2, 1, -2}, {2, 1 + thick, 2}}, glass(index));
  aim(scene, {3.5, 0.5, 0}, {0, 0, 0});
  scene.render.max_depth = 3;  // through the slab once
  const double reflected = std::pow((index - 1) / (index + 1), 2), seems_away = 3 - thick + thick / index;
  const double expected = strength * pi * radius * radius * std::pow((1 - reflected) / seems_away, 2) * 0.73 / pi;
  CHECK(radiance_of(film_of(scene, 64)).mean == doctest::Approx(expected).epsilon(0.002).scale(0));
}

TEST_CASE("specular paths: what BSDF sampling finds, with less noise: through slabs and cubes, and reflected in them") {
  const auto slab = [](Scene& s) { add(s, upright, glass(1.5)); };
  check_floor("pane", {0.5, 0, 1}, 0.25, slab);
  check_floor("pane, on the lamp's side", {0.5, 0, -2}, 1, slab);
  check_floor("pane, at its narrow side", {3.3, 0, 0.4}, 0.5, slab);
  check_floor("turned cube", {0.4, 0, 0.9}, 0.5, [](Scene& s) {
    add(s, Box<>{{-0.5, 0.1, -0.5}, {0.5, 1.1, 0.5}}, glass(1.5), {RotateY{25}, Translate{{0.4, 0, -0.4}}});
  });
  check_floor("cube on the floor", {0.4, 0, 0.9}, 0.5, [](Scene& s) {
    add(s, Box<>{{-0.5, 0, -0.5}, {0.5, 1, 0.5}}, glass(2), {RotateY{25}, Translate{{0.4, 0, -0.4}}});
  });
}

TEST_CASE(
    "specular paths: what BSDF sampling finds through slabs, with less noise: all kinds of lights, two slabs, media") {
  check_floor("three lamps, a mirror, two panes", {0.5, 0, 1}, 1, [](Scene& s) {
    add(s, Sphere<>{{-1, 2, -3}, 0.2, Vec3d{0, 2.5, -3}}, lamp(20));
    add(s, Quad<>{{0, 3.5, -2}, {0.4, 0, 0}, {0.1, 0.1, 0.4}}, lamp(20));
    add(s, upright, glass(1.5));
    add(s, Box<>{{-1.5, 0.2, -0.3}, {-0.5, 2, -0.1}}, glass(1.6), {RotateY{10}});
    add(s, Quad<>{{4, 0, -4}, {0, 0, 6}, {1, 5, 0}}, metal(0.7, 0));
    s.camera.shutter_open = 0, s.camera.shutter_close = 1;
  });
  check_floor("fog", {0.5, 0, 1}, 1, [](Scene& s) {
    add(s, upright, glass(1.5));
    add_medium(s, Box<>{{-4, 0, -5}, {4, 4, 3}}, {0.1, 0.4}, 0.9);
  });
  check_floor("fog within", {0.5, 0, 1}, 1, [](Scene& s) {
    add(s, upright, glass(1.5));
    add_medium(s, upright, {2, 0.4}, 0.9);
  });
}

TEST_CASE("specular paths: in a white furnace slabs are invisible") {
  Scene scene = furnace_with_floor();
  add(scene, Box<>{{-2, 0.5, -1}, {-1, 1.5, 0}}, glass(1.5), {RotateY{20}});
  add(scene, Box<>{{-1, 0, 1}, {1.5, 2, 1.2}}, glass(1.7));
  CHECK(compile(scene).specular.flats.size() == 2);
  // Light that the floor scatters nearly level into the second slab, which stands on it, is kept in there for long: of
  // two million paths three have more than the usual 1000 events, none more than 4000.
  scene.render.max_depth = 10000;
  check_invisible(scene);
}

TEST_CASE("specular paths: which slabs take part") {
  const auto slabs = [](double light_radius, auto change) {
    return compile(floor_with(light_radius, change)).specular.flats.size();
  };
  const auto with = [&](auto more) { return slabs(0.1, [&](Scene& s) { add(s, upright, glass(1.5)), more(s); }); };
  CHECK(with([](Scene&) {}) == 1);
  CHECK(slabs(0.9, [](Scene& s) { add(s, upright, glass(1.5)); }) == 1);
  CHECK(slabs(1.1, [](Scene& s) { add(s, upright, glass(1.5)); }) == 0);   // 1.9 away
  CHECK(slabs(0.1, [](Scene& s) { add(s, upright, glass(1.41)); }) == 0);  // light leaves by the narrow sides
  CHECK(slabs(0.1, [](Scene& s) { add(s, upright, glass(1.42)); }) == 1);
  CHECK(slabs(0.1, [](Scene& s) { add(s, upright, glass(0.6)); }) == 0);
  CHECK(with([](Scene& s) { s.render.integrator = Integrator::nee; }) == 0);
  CHECK(with([](Scene& s) { s.render.caustics = Caustics::scatter; }) == 0);
  // What reaches into it, and what does not.
  CHECK(with([](Scene& s) { add(s, sphere({0, 1, 0}, 0.95), lambertian(0.5)); }) == 0);
  CHECK(with([](Scene& s) { add(s, sphere({0, 1, 0}, 0.85), lambertian(0.5)); }) == 1);
  CHECK(with([](Scene& s) { add(s, Sphere<>{{0, 1, 0}, 0.5, Vec3d{0, 1, -2}}, lambertian(0.5)); }) == 0);
  CHECK(with([](Scene& s) { add(s, sphere({0, 1, 0}, 9), glass(1.2)); }) == 1);  // around all of it
  CHECK(with([](Scene& s) { add(s, Quad<>{{0, 1, -1}, {1, 0, 0}, {0, 1, 0.2}}, lambertian(0.5)); }) == 0);
  CHECK(with([](Scene& s) { add(s, Quad<>{{0, 1, -0.9}, {1, 0, 0}, {0, 1, 0.2}}, lambertian(0.5)); }) == 1);
  CHECK(with([](Scene& s) { add(s, Box<>{{0, 1, -1.2}, {1, 2, 2}}, lambertian(0.5)); }) == 0);
  CHECK(with([](Scene& s) { add(s, Box<>{{-9, -1, -9}, {9, 9, 9}}, lambertian(0.5)); }) == 1);
  CHECK(with([](Scene& s) { add_medium(s, Box<>{{-5, 0, -5}, {5, 5, 5}}, {0.1, 0}, 1); }) == 1);
  CHECK(with([](Scene& s) { add_medium(s, Box<>{{-5, 0, -1}, {5, 5, 5}}, {0.1, 0}, 1); }) == 0);
  CHECK(with([](Scene& s) { add_medium(s, sphere({0, 1, 4}, 3), {0.1, 0}, 1); }) == 1);
}

TEST_CASE("specular paths: faces of a slab that something touches are closed, and no others") {
  const auto closed = [](auto change) {
    const RenderScene compiled = compile(floor_with(0.1, change));
    REQUIRE(compiled.specular.flats.size() == 1);
    return compiled.specular.flats[0].closed;
  };
  CHECK(closed([](Scene& s) { add(s, upright, glass(1.5)); }) == 0);
  CHECK(closed([](Scene& s) { add(s, Box<>{{-2, 0, -1.1}, {3, 3, -0.9}}, glass(1.5)); }) == 1 << 2);  // the floor
  CHECK(closed([](Scene& s) {
          add(s, upright, glass(1.5));
          add(s, Quad<>{{0, 1, -0.9}, {1, 0, 0}, {0, 1, 0}}, lambertian(0.5));  // a label on it
        }) == 1 << 5);
  CHECK(closed([](Scene& s) {
          add(s, upright, glass(1.5));
          add(s, Box<>{{-3, 0.5, -2}, {-2, 4, 0}}, lambertian(0.5));
        }) == 1 << 0);
}

}  // namespace tyndall::test::specular_slabs_test
