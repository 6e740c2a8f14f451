#include "core/trace/lights.h"
#include "tests/support/directions.h"
#include "tests/support/mixed_scene.h"
#include "tests/support/probe.h"
#include "tests/support/thorough.h"

#include <doctest/doctest.h>

/// Directions to lights are drawn with the density that they are said to have, which integrates to 1.
namespace tyndall::test::light_pdf_test {

namespace {

Sampler<float> sampler_of(std::uint32_t i) { return Sampler<float>::of(1, i, i >> 12, i * 7u); }

/// Distance at which a line from the point meets light k; 0: it does not.
double distance_to(const Lights& lights, int k, Vec3d point, Vec3d direction) {
  const Vec3d to_corner = to_double(lights.corner[k]) - point;
  if (lights.kind[k] == Lights::sphere) {
    const double middle = dot(to_corner, direction), radius = lights.length_u[k];
    const Vec3d across = to_corner - middle * direction;
    const double square = radius * radius - dot(across, across);
    if (square < 0) return 0;
    const double near = middle - std::sqrt(square);
    return near > 0 ? near : std::max(middle + std::sqrt(square), 0.0);
  }
  const Vec3d u = to_double(lights.edge_u[k]), v = to_double(lights.edge_v[k]), n = cross(u, v);
  const double t = dot(to_corner, n) / dot(direction, n);
  const Vec3d at = t * direction - to_corner;
  const double a = dot(cross(at, v), n) / dot(n, n), b = dot(cross(u, at), n) / dot(n, n);
  const auto within = [](double x, float length) { return x >= 0 && x <= static_cast<double>(length); };
  return t > 0 && within(a, lights.length_u[k]) && within(b, lights.length_v[k]) ? t : 0;
}

/// Density of a direction: the sum over all lights that could have been sampled there.
double density_of(const SceneView& s, Vec3d point, Vec3d direction) {
  const Lights& lights = s.lights;
  double density = 0;
  for (int k = 0; k < lights.count(); ++k) {
    const double t = distance_to(lights, k, point, direction);
    if (!(t > 0)) continue;
    density +=
        static_cast<double>(light_pdf<float>(s, k, rounded(point), 0.0f, rounded(direction), static_cast<float>(t)));
  }
  return density;
}

void check(const std::vector<Object>& lamps, Vec3d from, Vec3d towards, double width) {
  const RenderScene scene = lit(lamps);
  const SceneViewOf view(scene);
  const Lights& lights = view.view().lights;
  const Vec3f point = rounded(from - scene.origin);
  CapCells cap(normalize(towards - from), width);
  const int drawn = thorough() ? 100000 : 20000;
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(drawn); ++i) {
    const Sampler<float> d = sampler_of(i);
    const LightChoice<float> choice = choose_light<float>(lights, point, d.next_1d(dimension::light_choice));
    const LightSample<float> s =
        sample_light<float>(view.view(), choice.light, point, 0, d.next_2d(dimension::light_point));
    REQUIRE(s.pdf > 0);
    cap.count(exact(s.direction));
  }
  const auto fraction = cap.integrate([&](Vec3d d) { return density_of(view.view(), exact(point), d); }, 120);
  CAPTURE(length(towards - from));
  CAPTURE(width);
  CHECK(cap.outside() == 0);
  CHECK(sum(fraction) == doctest::Approx(1).epsilon(2e-3).scale(0));
  CHECK(std::abs(cap.deviate(fraction, drawn)) < 4.5);
}

/// Width of the cap that holds a sphere of this radius at this distance.
double cap_width(double radius, double distance) {
  return distance > radius ? 1 - std::sqrt(1 - radius * radius / (distance * distance)) : 2;
}

}  // namespace

TEST_CASE("light densities: rectangles near, large, slanting and far away") {
  const Quad<> square{{-0.5, -0.5, 0}, {1, 0, 0}, {0, 1, 0}}, long_one{{-2, -0.1, 0}, {4, 0, 0}, {0, 0.2, 0}};
  check({light_object(square)}, {0, 0, 1}, {0, 0, 0}, cap_width(0.7072, 1));
  check({light_object(square)}, {0.3, -0.2, 0.05}, {0.3, -0.2, 0}, 1);
  check({light_object(square)}, {2, 1, 0.4}, {0, 0, 0}, cap_width(0.7072, std::sqrt(5.16)));
  check({light_object(square, {RotateY{40}})}, {30, 20, 50}, {0, 0, 0}, cap_width(0.7072, std::sqrt(3800)));
  check({light_object(long_one)}, {1, 0.3, 0.3}, {1, 0, 0.1}, 1.4);
}

TEST_CASE("light densities: parallelograms") {
  const Quad<> slanted{{-0.5, -0.5, 0}, {1, 0.2, 0}, {0.7, 1, 0.3}};
  check({light_object(slanted)}, {0.3, 0.1, 2}, {0.3, 0.1, 0.15}, cap_width(1.1, 1.85));
}

TEST_CASE("light densities: spheres, from inside and from just outside to far away") {
  for (const double distance : {0.5, 1.001, 1.2, 3.0, 1000.0})
    check({light_object(sphere({0, 0, 0}, 1))}, {0, distance * 0.6, distance * 0.8}, {0, 0, 0}, cap_width(1, distance));
}

TEST_CASE("light densities: a box, of which rays meet two faces") {
  const Object box = light_object(Box<>{{-0.5, -0.4, -0.3}, {0.5, 0.4, 0.3}}, {RotateY{25}});
  check({box}, {1.5, 1, 0.7}, {0, 0, 0}, cap_width(0.7072, std::sqrt(3.74)));
  check({box}, {0.1, 0.2, 0.05}, {0, 0, 0}, 2);
}

TEST_CASE("light densities: several lights, few chosen by what they are worth, many by their power") {
  Engine engine(9);
  for (const int count : {3, 40}) {
    std::vector<Object> lamps;
    for (int i = 0; i < count; ++i)
      lamps.push_back(light_object(sphere(in_cube(engine, 1), uniform(engine, 0.1, 0.4))));
    check(lamps, {0.3, 0.5, 4}, {0, 0, 0}, cap_width(2.2, 4.04));
  }
}

}  // namespace tyndall::test::light_pdf_test
