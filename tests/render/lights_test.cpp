#include "tests/support/probe.h"

#include <doctest/doctest.h>

/// Irradiance of lights of radiance 1 on a matt surface: its radiance is albedo · E / π.
namespace tyndall::test::lights_test {

namespace {

constexpr double albedo = 0.8;

/// A matt floor about the origin, normal y, seen from a point just above it.
Scene floor_seen_from(Vec3d eye) {
  Scene scene = dark_room();
  add(scene, Quad<>{{-0.05, 0, -0.05}, {0, 0, 0.1}, {0.1, 0, 0}}, lambertian(albedo));
  aim(scene, eye, {0, 0, 0});
  return scene;
}

/// Gathers measured irradiances and compares them with expected ones. Each measurement has a seed of its own.
class Irradiances {
 public:
  void check(Scene scene, double irradiance) {
    scene.render.seed = ++seed_;
    const int spp = irradiance > 0.1 ? 512 : 4096;
    scores_.add("radiance", radiance(scene, spp), albedo * irradiance / pi, 0.01);
  }

 private:
  ZScores scores_;
  std::uint32_t seed_ = 0;
};

}  // namespace

TEST_CASE("light: square lights above a floor, in the middle and at a corner") {
  struct Case {
    double height, centred, corner;
  };
  constexpr Case cases[] = {{0.1, 3.0421284383700384, 0.7790251546008615},
                            {1.0, 0.7522746884541074, 0.4352098756835516},
                            {5.0, 0.039474025278868424, 0.03797951742057062}};
  Irradiances lamps;
  for (const Case& c : cases)
    for (const bool corner : {false, true}) {
      Scene scene = floor_seen_from({0.01, 0.02, 0.005});
      const double from = corner ? 0 : -0.5;
      add(scene, Quad<>{{from, c.height, from}, {1, 0, 0}, {0, 0, 1}}, lamp(1));
      lamps.check(scene, corner ? c.corner : c.centred);
      // Both of a light's sides shine alike.
      scene.objects.pop_back();
      add(scene, Quad<>{{from, c.height, from}, {0, 0, 1}, {1, 0, 0}}, lamp(1));
      lamps.check(scene, corner ? c.corner : c.centred);
    }
}

TEST_CASE("light: a luminous wall, and the light of the Cornell box") {
  Irradiances lamps;
  Scene wall = floor_seen_from({-0.01, 0.02, 0.005});
  add(wall, Quad<>{{1, 0, -0.5}, {0, 1, 0}, {0, 0, 1}}, lamp(1));
  lamps.check(wall, 0.22334662582831763);
  for (const bool middle : {true, false}) {
    Scene box = dark_room();
    const Vec3d at = middle ? Vec3d{278, 0, 279.5} : Vec3d{100, 0, 100};
    add(box, Quad<>{{0, 0, 0}, {0, 0, 555}, {555, 0, 0}}, lambertian(albedo));
    add(box, Quad<>{{213, 554, 227}, {130, 0, 0}, {0, 0, 105}}, lamp(1));
    aim(box, at + Vec3d{1, 5, 2}, at);
    lamps.check(box, middle ? 0.04381097465468578 : 0.030281438000668903);
  }
}

TEST_CASE("light: luminous spheres, close, slanted and far") {
  struct Case {
    double distance, degrees, irradiance;
  };
  constexpr Case cases[] = {{1.01, 0, 3.0796908671598797},
                            {2, 0, 0.7853981633974484},
                            {2, 45, 0.555360367269796},
                            {2, 60, 0.39269908169872436},
                            {10, 30, 0.0272069904635133}};
  Irradiances lamps;
  for (const Case& c : cases)
    for (const double radius : {1.0, -1.0}) {
      Scene scene = floor_seen_from({0.001, 0.002, 0.0005});
      const double angle = c.degrees * (pi / 180);
      add(scene, sphere({c.distance * std::sin(angle), c.distance * std::cos(angle), 0}, radius), lamp(1));
      lamps.check(scene, c.irradiance);
    }
}

TEST_CASE("light: a luminous box is its six faces") {
  Scene scene = floor_seen_from({0.01, 0.02, 0.005});
  add(scene, Box<>{{-0.5, 1, -0.5}, {0.5, 4, 0.5}}, lamp(1));  // only the lower face is seen
  Irradiances lamps;
  lamps.check(scene, 0.7522746884541074);
}

TEST_CASE("light: seen directly, through glass of index 1 and from inside it shows its radiance") {
  for (const double radius : {1.0, -1.0}) {
    Scene scene = dark_room();
    add(scene, sphere({0, 0, 0}, radius), lamp(3.5));
    aim(scene, {0, 0, 5}, {0.3, 0.2, 0});
    CHECK(common_value(scene) == 3.5);
    aim(scene, {0, 0.2, 0.1}, {0, 0, 5});
    CHECK(common_value(scene) == 3.5);
    add(scene, sphere({0, 0, 0}, 2), glass(1));
    aim(scene, {0, 0, 5}, {0.3, 0.2, 0});
    CHECK(common_value(scene) == 3.5);
  }
}

}  // namespace tyndall::test::lights_test
