#include "tests/support/lit_floor.h"

#include <doctest/doctest.h>

#include <cmath>

/// Lights found by exact specular paths off flat mirrors: the light is what scattering alone finds in the end.
namespace tyndall::test::specular_mirrors_test {

namespace {

const Vec3d hanging{1.5, 3, -2};
const Quad<> wall{{-6, 0, -4}, {12, 0, 0}, {0, 8, 0}};

void check_floor(const std::string& name, Vec3d point, double less_noise, auto change) {
  Scene scene = lit_floor(0.3, hanging, 20);
  change(scene);
  REQUIRE(compile(scene).specular.flats.size() > 0);
  check_point_of_floor(name, scene, point, less_noise);
}

}  // namespace

TEST_CASE("specular paths: the image of a light in a flat mirror") {
  const Vec3d image{1.5, 3, -6}, point{0.5, 0, 1};
  const double radius = 0.01, strength = 1e5;
  Scene scene = lit_floor(radius, hanging, strength);
  add(scene, Quad<>{{-6, -1, -4}, {12, 0, 0}, {3, 9, 0}}, metal(0.8, 0));
  aim(scene, {3, 2.5, 4}, point);
  const auto irradiance = [&](Vec3d lamp) {
    const Vec3d to_light = lamp - point;
    return strength * pi * radius * radius * to_light.y / std::pow(length(to_light), 3);
  };
  scene.render.max_depth = 2;  // not the lit floor's image in the mirror
  const double expected = 0.73 / pi * (irradiance(hanging) + 0.8 * irradiance(image));
  CHECK(radiance_of(film_of(scene, 64)).mean == doctest::Approx(expected).epsilon(0.002).scale(0));
}

TEST_CASE("specular paths: what BSDF sampling finds, with less noise: off quads and boxes of metal, from both sides") {
  check_floor("parallelogram", {0.5, 0, 1}, 0.25, [](Scene& s) {
    add(s, Quad<>{{-6, 0, -4}, {12, 0, 0}, {4, 8, 0}}, metal(0.9, 0));
  });
  check_floor("back of a quad", {0.5, 0, 1}, 0.25, [](Scene& s) {
    add(s, Quad<>{{-6, 0, -4}, {0, 8, 0}, {12, 0, 0}}, metal(0.9, 0));
  });
  check_floor("turned block", {0.55, 0, -1.05}, 0.5, [](Scene& s) {
    add(s, Box<>{{-1, 0, -1}, {1, 3, 1}}, metal(0.9, 0), {RotateY{30}, Translate{{-1.5, 0, 0}}});
  });
  check_floor("room of metal", {0.5, 0, 1}, 1, [](Scene& s) {
    s.render.max_depth = 200;
    add(s, Box<>{{-5, -0.1, -4}, {5, 6, 7}}, metal(0.4, 0));
  });
}

TEST_CASE("specular paths: what BSDF sampling finds off flat mirrors, with less noise: textures, all lights, media") {
  check_floor("tiles", {0.5, 0, 1}, 0.25, [](Scene& s) {
    s.textures.push_back({"tiles", Checker<>{0.7, {0.1, 0.5, 1}, {0.9, 0.7, 0.2}}});
    add(s, wall, {"", TextureIndex{0}, Metal<>{0}});
  });
  check_floor("three lamps and two mirrors", {0.5, 0, 1}, 0.5, [](Scene& s) {
    add(s, Sphere<>{{-1, 2, -2}, 0.2, Vec3d{0, 2.5, -2}}, lamp(20));
    add(s, Quad<>{{0, 3.5, -1}, {0.4, 0, 0}, {0.1, 0.1, 0.4}}, lamp(20));
    add(s, wall, metal(0.9, 0));
    add(s, Quad<>{{4, 0, -4}, {0, 0, 6}, {1, 5, 0}}, metal(0.7, 0));
    s.camera.shutter_open = 0, s.camera.shutter_close = 1;
  });
  check_floor("beside a ball of glass", {0.5, 0, 1}, 1, [](Scene& s) {
    add(s, wall, metal(0.9, 0));
    add(s, sphere({0.7, 1, 0}, 0.8), glass(1.5));
  });
  check_floor("fog", {0.5, 0, 1}, 1, [](Scene& s) {
    add(s, wall, metal(0.9, 0));
    add_medium(s, Box<>{{-3, 0, -5}, {3, 4, 3}}, {0.1, 0.4}, 0.9);
  });
}

TEST_CASE("specular paths: in a white furnace flat mirrors are invisible") {
  Scene scene = furnace_with_floor();
  add(scene, Box<>{{-2, 0.5, -1}, {-1, 1.5, 0}}, metal(1, 0), {RotateY{20}});
  add(scene, Quad<>{{-1, 0, 1}, {2.5, 0, 0}, {0, 2, 0.2}}, metal(1, 0));
  CHECK(compile(scene).specular.flats.size() > 1);
  check_invisible(scene);
}

TEST_CASE("specular paths: flat mirrors pay for lights that are small as seen from them, where their light is seen") {
  const auto pairs = [](double light_radius, auto change) {
    Scene scene = lit_floor(light_radius, {0, 4, 0}, 1);
    change(scene);
    return compile(scene).specular.sphere.size();
  };
  CHECK(pairs(0.1, [](Scene& s) { add(s, wall, metal(0.8, 0)); }) == 1);
  CHECK(pairs(1.99, [](Scene& s) { add(s, wall, metal(0.8, 0)); }) == 1);
  CHECK(pairs(2.01, [](Scene& s) { add(s, wall, metal(0.8, 0)); }) == 0);
  CHECK(pairs(0.1, [](Scene& s) { add(s, wall, metal(0.8, 0.005)); }) == 0);
  CHECK(pairs(0.1, [](Scene& s) { add(s, wall, glass(1.5)); }) == 0);
  CHECK(pairs(0.1, [](Scene& s) { s.render.integrator = Integrator::nee, add(s, wall, metal(0.8, 0)); }) == 0);
  // The light is above this block and beside it: the upper face sends its light upward, where nothing is.
  const Box<> block{{2, 1, -1}, {3, 2, 1}};
  CHECK(pairs(0.1, [&](Scene& s) { add(s, block, metal(0.8, 0)); }) == 1);
  CHECK(pairs(0.1, [&](Scene& s) {
          add(s, block, metal(0.8, 0));
          add(s, Quad<>{{-6, 6, -6}, {12, 0, 0}, {0, 0, 12}}, lambertian(0.5));
        }) == 2);
  CHECK(pairs(0.1, [](Scene& s) { add(s, Box<>{{-7, -1, -7}, {7, 9, 7}}, metal(0.8, 0)); }) == 6);  // around it
}

TEST_CASE("specular paths: flat mirrors that another surface covers, even in part, are left to BSDF sampling") {
  const auto mirrors = [](auto change) {
    Scene scene = lit_floor(0.1, {0, 4, 0}, 1);
    add(scene, Quad<>{{-3, 0, -4}, {6, 0, 0}, {0, 4, 0}}, metal(0.8, 0));  // it stands on the floor
    change(scene);
    return compile(scene).specular.flats.size();
  };
  const auto picture = [](double z) { return Quad<>{{-1, 1, z}, {1, 0, 0}, {0, 1, 0}}; };
  CHECK(mirrors([](Scene&) {}) == 1);
  CHECK(mirrors([&](Scene& s) { add(s, picture(-4), lambertian(0.5)); }) == 0);
  CHECK(mirrors([&](Scene& s) { add(s, picture(-3.999), lambertian(0.5)); }) == 1);
  CHECK(mirrors([&](Scene& s) { add(s, picture(-4), metal(0.5, 0)); }) == 0);
  CHECK(mirrors([](Scene& s) {
          add(s, Quad<>{{3, 1, -4}, {1, 0, 0}, {0, 1, 0}}, lambertian(0.5));
        }) == 1);  // beside it
  CHECK(mirrors([](Scene& s) { add(s, Quad<>{{-1, 1, -5}, {1, 0, 0}, {0, 0, 3}}, lambertian(0.5)); }) == 1);  // a shelf
  CHECK(mirrors([](Scene& s) { add(s, Box<>{{-9, -1, -4}, {9, 9, 9}}, lambertian(0.5)); }) == 0);
}

}  // namespace tyndall::test::specular_mirrors_test
