#include "core/compile/columns.h"
#include "tests/support/probe.h"
#include "tests/support/skies.h"
#include "tests/support/thorough.h"

#include <doctest/doctest.h>

/// The sun of a picture of the sky, through and off spheres.
namespace tyndall::test::sun_paths_test {

namespace {

/// A matt floor under a sun, with what stands on it.
Scene floor_under_sun() {
  Scene scene = white_room();
  SkyPicture sky = sunny_sky(3000);
  sky.rotate_y = 40;
  scene.background = sky;
  scene.render.integrator = Integrator::mis;
  scene.render.sharing = false;
  scene.render.max_depth = 10000;
  add(scene, Quad<>{{-30, 0, -30}, {0, 0, 60}, {60, 0, 0}}, lambertian(0.6));
  return scene;
}

SkySun sun_of(const SkyPicture& sky) { return sky_columns(sky, true, nullptr).distribution.sun; }

/// A direction, as towards the sun of floor_under_sun().
Vec3d towards_sun(const Scene& scene) {
  const Vec3f axis = sky_columns(scene.background, true, nullptr).sun_axis;
  return {static_cast<double>(axis.x), static_cast<double>(axis.y), static_cast<double>(axis.z)};
}

}  // namespace

TEST_CASE("sun: the brightest spot if it is small and gives much of the light, else none") {
  const SkySun sun = sun_of(sunny_sky(1000));
  CHECK(sun.tangent > 0.04);  // half a texel of 64 is 0.049
  CHECK(sun.tangent < 0.12);
  const double theta = pi * 9.5 / 32, phi = 2 * pi * 20.5 / 64;
  const Vec3d middle{-std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi)};
  CHECK(length(sun.axis - middle) < 1e-5);
  const double texel = 2 * pi * pi / 64 / 32 * std::sin(theta);
  CHECK(sun.irradiance > 999.9 * texel);
  CHECK(sun.irradiance < 1008.5 * texel);  // with the eight texels around it
  CHECK(std::abs(dot(sun.edge_u, sun.axis)) + std::abs(dot(sun.edge_v, sun.axis)) < 1e-5);
  CHECK(sun_of(uniform_sky(64, 32, 1)).tangent == 0);
  for (const int column : {0, 63}) {  // beside the picture's edge
    const SkySun beside_edge = sun_of(sunny_sky(1000, column));
    CHECK(beside_edge.tangent == doctest::Approx(sun.tangent).epsilon(1e-3));
    CHECK(beside_edge.irradiance == doctest::Approx(sun.irradiance).epsilon(1e-4));
  }
  CHECK(sun_of(uniform_sky(1, 1, 1)).tangent == 0);
  CHECK(sun_of(sunny_sky(20)).tangent == 0);  // 20 of 64 x 32 texels of 1: a hundredth of the light
  CHECK(sun_of(random_sky(64, 32, 3)).tangent == 0);
}

TEST_CASE("sun: its light through and off spheres is that which chance finds, with far less noise") {
  struct Case {
    std::string name;
    std::vector<std::pair<Sphere<>, Material>> spheres;
    double across;  // from the point under the sphere's shadow: where the light is looked for
    double gain;    // least factor by which the variance falls
    bool fog = false;
  };
  const Sphere<> ball = sphere({0, 1.4, 0}, 1), hollow = sphere({0, 1.4, 0}, -0.8);
  const Case cases[] = {{"glass", {{ball, glass(1.5)}}, 0.1, 4},
                        {"shell", {{ball, glass(1.5)}, {hollow, glass(1.5)}}, 0.5, 1.5},
                        {"mirror", {{ball, metal(0.9, 0)}}, -2.5, 1.5},
                        {"fog", {{ball, glass(1.5)}}, 0.1, 2, true}};
  for (const Case& c : tried(cases, 1)) {
    CAPTURE(c.name);
    Scene scene = floor_under_sun();
    for (const auto& [shape, material] : c.spheres) add(scene, shape, material);
    if (c.fog) add_medium(scene, Box<>{{-4, 0.05, -4}, {4, 3, 4}}, {0.08, 0.3}, 0.9);
    const Vec3d sun = towards_sun(scene);
    const Vec3d away = (-1 / std::hypot(sun.x, sun.z)) * Vec3d{sun.x, 0, sun.z};
    const double shadow = 1.4 * std::hypot(sun.x, sun.z) / sun.y;  // where the shadow's middle is
    const Vec3d at = (shadow + c.across) * away;
    aim(scene, at + Vec3d{0, 0.04, 0} + 0.05 * away, at);
    Estimate found[2];
    for (const bool solved : {false, true}) {
      scene.render.caustics = solved ? Caustics::chains : Caustics::scatter;
      found[solved ? 1 : 0] = radiance(scene, 4096);
    }
    check_agree(found[0], found[1]);
    CHECK(found[0].error < 0.1 * found[0].mean);
    CHECK(c.gain * found[1].error * found[1].error <= found[0].error * found[0].error);
  }
}

TEST_CASE("sun: a scene whose only smooth things are spheres leaves no rare paths to chance") {
  Scene scene = floor_under_sun();
  add(scene, sphere({0, 1.4, 0}, 1), glass(1.5));
  const PreparedScene solved(std::make_shared<const Scene>(scene), compile(scene));
  scene.render.caustics = Caustics::scatter;
  const PreparedScene by_chance(std::make_shared<const Scene>(scene), compile(scene));
  CHECK(by_chance.caustic_chance() < 0.01);
  CHECK(solved.caustic_chance() > 0.5);
}

}  // namespace tyndall::test::sun_paths_test
