#include "core/compile/overlap.h"
#include "tests/support/probe.h"

#include <doctest/doctest.h>

namespace tyndall::test::visibility_test {

namespace {

constexpr Vec3d above{0, 5.2, 0};

/// A mirror sphere of radius 1 on the way from a light to the floor.
Scene sphere_under_light(double light_radius) {
  Scene scene = lit_floor(light_radius, above, 1);
  add(scene, sphere({0, 1.2, 0}, 1), metal(0.8, 0));
  return scene;
}

double fraction_of_first_light(const Scene& scene, const Sphere<>& ball) {
  const RenderScene compiled = compile(scene);
  return visible_fraction(list_obstacles(flatten(scene)), compiled.lights, 0, compiled.origin, round_body(ball, {}));
}
double fraction_of_first_light(const Scene& scene) { return fraction_of_first_light(scene, sphere({0, 1.2, 0}, 1)); }

}  // namespace

TEST_CASE("sight: what stands between a lamp and a ball hides a share of the lamp") {
  Scene scene = sphere_under_light(0.2);
  CHECK(fraction_of_first_light(scene) == 1);
  add(scene, Quad<>{{0, 3, -3}, {3, 0, 0}, {0, 0, 6}}, lambertian(0.5));
  CHECK(fraction_of_first_light(scene) == doctest::Approx(0.5).epsilon(0.05));
  add(scene, Box<>{{-3, 3, -3}, {0, 3.1, 3}}, lambertian(0.5));
  CHECK(fraction_of_first_light(scene) == 1.0 / 64);
}

TEST_CASE("sight: a small sphere hides as much of the ball as its shadow covers") {
  Scene scene = sphere_under_light(0.001);
  add(scene, sphere({0, 3.2, 0}, 0.2), lambertian(0.5));
  const double shadow = 4 * 0.1 / std::sqrt(1 - 0.1 * 0.1);  // its radius at the middle of the sphere
  CHECK(fraction_of_first_light(scene) == doctest::Approx(1 - shadow * shadow).epsilon(0.04));
}

TEST_CASE("sight: a ceiling behind a lamp, glass around it and things behind the ball hide nothing") {
  Scene scene = dark_room();
  add(scene, Quad<>{{-6, 0, -6}, {12, 0, 0}, {0, 0, 12}}, lambertian(0.7));
  add(scene, Quad<>{{-6, 6, -6}, {12, 0, 0}, {0, 0, 12}}, lambertian(0.7));
  add(scene, Quad<>{{-0.5, 5.999, -0.5}, {1, 0, 0}, {0, 0, 1}}, lamp(1));
  add(scene, sphere({0, 6, 0}, 1), glass(1.5));
  add(scene, sphere({0, 1.2, 0}, 1), glass(1.5));
  add(scene, sphere({0, 1.2, 0}, -0.9), glass(1.5));
  CHECK(fraction_of_first_light(scene) == 1);
  CHECK(fraction_of_first_light(scene, sphere({0, 6, 0}, 1)) == 1);  // the light is within
}

TEST_CASE("sight: chains ask less for a lamp that the ball does not see") {
  Scene scene = sphere_under_light(0.2);
  const auto worth = [&] {
    const RenderScene compiled = compile(scene);
    REQUIRE(compiled.specular.sphere.size() == 1);
    return compiled.specular.choice.power[0];
  };
  const float before = worth();
  add(scene, Quad<>{{-3, 3, -3}, {6, 0, 0}, {0, 0, 6}}, lambertian(0.5));
  CHECK(worth() == doctest::Approx(before / 8));
}

TEST_CASE("overlap: a ball within another one, which it does not touch, is none") {
  Scene scene = dark_room();
  add(scene, sphere({0, 0, 0}, 2), glass(1.5));
  const Flattened flat = flatten(scene);
  CHECK_FALSE(is_overlapped(flat, round_body(sphere({0, 0, 0}, 1), {}), {}));
  CHECK(is_overlapped(flat, round_body(sphere({1.5, 0, 0}, 1), {}), {}));
  CHECK_FALSE(is_overlapped(flat, round_body(sphere({3.5, 0, 0}, 1), {}), {}));
}

}  // namespace tyndall::test::visibility_test
