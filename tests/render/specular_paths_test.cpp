#include "tests/support/lit_floor.h"

#include <doctest/doctest.h>

#include <cmath>

/// Lights found by exact specular paths through and off single spheres: the light is what scattering alone finds in the
/// end.
namespace tyndall::test::specular_paths_test {

namespace {

/// Where a ray from `point` in direction `d` off the unit ball around `center` meets the plane through `light` across
/// `normal`.
Vec3d by_mirror(Vec3d point, Vec3d d, Vec3d center, Vec3d lamp, Vec3d normal) {
  const Interval<double> line = sphere_interval(center - point, 1.0, d);
  const Vec3d at = point + line.near * d, out = reflect(d, at - center);
  return at + (dot(lamp - at, normal) / dot(out, normal)) * out;
}

/// Solid angle at a point over area at a light, off the sphere: found by Newton's method and by differences.
double mirror_spread(Vec3d point, Vec3d center, Vec3d lamp, Vec3d& direction) {
  direction = normalize(center - point);
  direction = normalize(direction + 0.4 * normalize(lamp - center));
  Vec3d normal{};
  double determinant = 0;
  constexpr double step = 1e-6;
  for (int i = 0; i < 60; ++i) {
    const Basis<double> across = basis_around(direction);
    const Interval<double> line = sphere_interval(center - point, 1.0, direction);
    const Vec3d at = point + line.near * direction;
    normal = normalize(reflect(direction, at - center));
    const Basis<double> there = basis_around(normal);
    const auto place = [&](Vec3d d) { return by_mirror(point, normalize(d), center, lamp, normal) - lamp; };
    const Vec3d here = place(direction), s = (1 / step) * (place(direction + step * across.s) - here),
                t = (1 / step) * (place(direction + step * across.t) - here);
    const double a = dot(s, there.s), b = dot(t, there.s), c = dot(s, there.t), d = dot(t, there.t);
    determinant = a * d - b * c;
    const double x = dot(here, there.s), y = dot(here, there.t);
    const double u = -(d * x - b * y) / determinant, v = -(a * y - c * x) / determinant;
    const double scale = std::min(1.0, 0.2 / std::hypot(u, v));
    direction = normalize(direction + (scale * u) * across.s + (scale * v) * across.t);
  }
  return 1 / std::abs(determinant);
}

}  // namespace

TEST_CASE("specular paths: the image of a small light in a mirror sphere") {
  const Vec3d light_center{2.5, 3, 0.5}, center{0, 1.2, 0}, point{2, 0, 0.4};
  const double radius = 0.01, strength = 1e5;
  Scene scene = lit_floor(radius, light_center, strength);
  add(scene, sphere(center, 1), metal(1, 0));
  aim(scene, {3, 2.5, 4}, point);
  Vec3d direction;
  const double spread = mirror_spread(point, center, light_center, direction);
  const Vec3d to_light = light_center - point;
  const double direct = to_light.y / std::pow(length(to_light), 3);
  const double irradiance = strength * pi * radius * radius * (direct + spread * direction.y);
  CHECK(spread * direction.y > 0.02 * direct);
  scene.render.max_depth = 2;  // not the lit floor's image in the sphere
  CHECK(radiance_of(film_of(scene, 64)).mean == doctest::Approx(0.73 / pi * irradiance).epsilon(0.002).scale(0));
}

TEST_CASE(
    "specular paths: what BSDF sampling finds, with less noise: off a mirror, through glass, shells and out of bulbs") {
  const auto with = [](const char* name, double light_radius, Vec3d light_center, Vec3d point, double less_noise,
                       auto add_spheres) {
    Scene scene = lit_floor(light_radius, light_center, 20);
    add_spheres(scene);
    check_point_of_floor(name, scene, point, less_noise);
  };
  const Vec3d above{1.5, 4.5, 0.5}, center{0, 1.2, 0};
  const auto shell = [](Scene& scene, Vec3d at, double inner) {
    add(scene, sphere(at, 1), glass(1.5));
    add(scene, sphere(at, -inner), glass(1.5));
  };
  with("mirror", 0.3, above, {1.6, 0, 1}, 0.3, [&](Scene& s) { add(s, sphere(center, 1), metal(0.9, 0)); });
  with("glass", 0.3, above, {-0.6, 0, 0.5}, 0.5, [&](Scene& s) { add(s, sphere(center, 1), glass(1.5)); });
  with("shell", 0.3, above, {-0.5, 0, 0.6}, 0.5, [&](Scene& s) { shell(s, center, 0.85); });
  with("bulb", 0.2, {0.2, 1.3, 0.1}, {1, 0, 1.5}, 0.5, [&](Scene& s) { shell(s, center, 0.85); });
  with("lamp in glass", 0.2, {0.2, 1.3, 0.1}, {1, 0, 1.5}, 0.5,
       [&](Scene& s) { add(s, sphere(center, 1), glass(1.5)); });
  with("sunk", 0.3, above, {-1.2, 0, 0.2}, 1, [&](Scene& s) { add(s, sphere({0, 0.6, 0}, 1), glass(1.5)); });
  with("fog in the ball", 0.3, above, {-0.6, 0, 0.5}, 1, [&](Scene& s) {
    add(s, sphere(center, 1), glass(1.5));
    add_medium(s, sphere(center, 1), {0.5, 0.3}, 0.9);
  });
}

TEST_CASE("specular paths: in a white furnace a mirror, a shell and a bulb are invisible") {
  Scene scene = furnace_with_floor();
  add(scene, sphere({-1.2, 1.2, 0}, 1), metal(1, 0));
  add(scene, sphere({1.2, 1.2, 0}, 1), glass(1.5));
  add(scene, sphere({1.2, 1.2, 0}, -0.8), glass(1.5));
  add(scene, sphere({1.3, 1.3, 0}, 0.1), lamp(1));
  CHECK(compile(scene).specular.sphere.size() == 4);  // each light by each sphere
  check_invisible(scene);
}

TEST_CASE("specular paths: they pay for lights that are small as seen from the sphere, and only then") {
  const auto pairs = [](double light_radius, auto change) {
    Scene scene = lit_floor(light_radius, {0, 5.2, 0}, 1);
    add(scene, sphere({0, 1.2, 0}, 1), glass(1.5));
    change(scene);
    return compile(scene).specular.sphere.size();
  };
  const auto nothing = [](Scene&) {};
  CHECK(pairs(0.1, nothing) == 1);
  CHECK(pairs(0.59, nothing) == 1);
  CHECK(pairs(0.61, nothing) == 0);
  const auto mirror = [](Scene& s) { s.materials.back() = metal(0.8, 0); };
  CHECK(pairs(0.99, mirror) == 1);
  CHECK(pairs(1.01, mirror) == 0);
  CHECK(pairs(0.1, [](Scene& s) { s.render.integrator = Integrator::nee; }) == 0);
  CHECK(pairs(0.1, [](Scene& s) { s.render.caustics = Caustics::scatter; }) == 0);
  CHECK(pairs(0.1, [](Scene& s) { s.render.fresnel = FresnelKind::schlick; }) == 0);
  CHECK(pairs(0.1, [](Scene& s) { add(s, sphere({0, 1.2, 0}, -0.8), glass(1.5)); }) == 1);
  CHECK(pairs(0.1, [](Scene& s) { add(s, sphere({0, 1.2, 0}, 0.8), glass(1.2)); }) == 0);  // filled with something else
  CHECK(pairs(0.1, [](Scene& s) { add(s, sphere({3, 1, 0}, 0.5), metal(0.8, 0.1)); }) == 1);
  CHECK(pairs(0.1, [](Scene& s) { add(s, sphere({0, 1.2, 0}, -1), glass(1.2)); }) == 0);  // two in one place
}

}  // namespace tyndall::test::specular_paths_test
