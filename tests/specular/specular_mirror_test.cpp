#include "core/specular/specular_flat.h"

#include "core/trace/scene_view.h"
#include "tests/support/mixed_scene.h"
#include "tests/support/probe.h"

#include <doctest/doctest.h>

#include <cmath>

/// Paths off flat mirrors: they obey the law of reflection. Known answers of verify tell the solid angle that they
/// fill.
namespace tyndall::test::specular_mirror_test {

namespace {

/// A floor and a light, and a mirror that is turned: a parallelogram around (1, 2, -1).
struct MirrorScene {
  Vec3d u{2, 0.3, 0.1}, v{0.4, 1.5, -0.2};  // half edges
  RenderScene compiled;
  SceneViewOf view;

  static RenderScene make(Vec3d u, Vec3d v) {
    Scene scene = dark_room();
    scene.render.integrator = Integrator::mis;
    add(scene, Quad<>{{-9, -3, -9}, {18, 0, 0}, {0, 0, 18}}, lambertian(0.5));
    add(scene, sphere({1, 4, 3}, 0.01), lamp(1));
    const Vec3d middle{1, 2, -1};
    add(scene, Quad<>{middle - u - v, 2.0 * u, 2.0 * v}, metal(0.9, 0));
    return compile(scene);
  }
  MirrorScene() : compiled(make(u, v)), view(compiled) {}
  Vec3d middle() const { return Vec3d{1, 2, -1} - compiled.origin; }
};

}  // namespace

TEST_CASE(
    "specular paths: the one off a flat mirror obeys the law of reflection, and is found where it meets the face") {
  const MirrorScene scene;
  const SpecularPairs& specular = scene.view.view().specular;
  REQUIRE(specular.spheres() == 1);
  REQUIRE(specular.first_mirror == 0);
  const SpecularFlat<double> m = load_flat<double>(specular, 0);
  const SpecularFlat<float> in_floats = load_flat<float>(specular, 0);
  const Vec3d normal = normalize(cross(scene.u, scene.v)), edge = cross(scene.v, normal),
              other = cross(normal, scene.u);
  Engine engine(3);
  int found = 0, apart = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vec3d near = scene.middle() + in_cube(engine, 4), far = scene.middle() + in_cube(engine, 4);
    const double below = dot(near - scene.middle(), normal), above = dot(far - scene.middle(), normal);
    const SpecularPath<double> path = mirror_path(m, near, far);
    if (below * above <= 0) {
      CHECK_FALSE(path.found);
      ++apart;
      continue;
    }
    const Vec3d at = near + path.near_distance * path.direction, from_middle = at - scene.middle();
    CHECK(std::abs(dot(from_middle, normal)) < 1e-5);
    CHECK(length(path.arrive - reflect(path.direction, normal)) < 1e-6);
    CHECK(length(at + path.far_distance * path.arrive - far) < 1e-5);
    CHECK(path.from == 4 * path.wall + (below < 0 ? 1 : 0));
    const double a = std::abs(dot(from_middle, edge) / dot(scene.u, edge));
    const double b = std::abs(dot(from_middle, other) / dot(scene.v, other));
    if (std::abs(a - 1) > 1e-4 && std::abs(b - 1) > 1e-4) CHECK(path.found == (a < 1 && b < 1));
    found += path.found ? 1 : 0;
    const SpecularPath<float> rough = mirror_path(in_floats, rounded(near), rounded(far));
    CHECK(length(exact(rough.direction) - path.direction) < 1e-4);
    CHECK(static_cast<double>(rough.spread) == doctest::Approx(path.spread).epsilon(1e-5).scale(0));
  }
  CHECK(found > 300);
  CHECK(apart > 1000);
}

TEST_CASE(
    "specular paths: a mirror counts as much as its image of the light where that is seen, and little elsewhere") {
  const MirrorScene scene;
  const SpecularPairs& specular = scene.view.view().specular;
  const SpecularFlat<double> m = load_flat<double>(specular, 0);
  const Vec3d lamp = exact(specular.choice.center[0]);
  const double power = static_cast<double>(specular.choice.power[0]);
  Engine engine(7);
  int seen = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3d point = scene.middle() + in_cube(engine, 4), direction = mirrored(m, point) - lamp;
    const double worth = mirror_worth<double>(specular, 0, point), full = power / dot(direction, direction);
    if (mirror_path(m, point, lamp).found) {
      CHECK(worth == doctest::Approx(full));
      ++seen;
    } else {
      CHECK(worth >= full * static_cast<double>(min_mirror_worth) * 0.999);
      CHECK(worth <= full * 1.001);
    }
  }
  CHECK(seen > 200);
}

}  // namespace tyndall::test::specular_mirror_test
