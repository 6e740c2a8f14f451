#include "tests/support/capture.h"
#include "tests/support/probe.h"

#include <doctest/doctest.h>

/// Slabs of medium against radiative transfer solved by adding and doubling; extreme densities.
namespace tyndall::test::media_slow_test {

namespace {

/// A slab of thickness 1 below y = 0, seen from above at an angle to the vertical; light from above or from below.
Scene slab(Medium<> medium, double albedo, double degrees_off, bool light_above, double distance = 3) {
  Scene scene = white_room();
  const double size = 40 * std::max(1.0, 1 / medium.density);
  add_medium(scene, Box<>{{-size, -1, -size}, {size, 0, size}}, medium, albedo);
  const double a = degrees_off * (pi / 180);
  aim(scene, {distance * std::sin(a), distance * std::cos(a), 0}, {0, 0, 0});
  scene.background = light_above ? Hemispheres{{1, 1, 1}, {0, 0, 0}} : Hemispheres{{0, 0, 0}, {1, 1, 1}};
  scene.render.max_depth = 1000000;
  return scene;
}

}  // namespace

TEST_CASE("slab: reflects and transmits as radiative transfer says") {
  struct Case {
    double depth, albedo, reflected, transmitted, reflected60, transmitted60;
  };
  constexpr Case cases[] = {{0.1, 0.5, 0.02173299, 0.9264651, 0.04149825, 0.859828},
                            {0.1, 1.0, 0.04768859, 0.9523114, 0.09104318, 0.9089568},
                            {1.0, 0.5, 0.09911919, 0.4460584, 0.1497538, 0.2302852},
                            {1.0, 0.9, 0.2674103, 0.5916251, 0.3936617, 0.4148399},
                            {1.0, 1.0, 0.3413288, 0.6586712, 0.4983755, 0.5016245},
                            {4.0, 0.5, 0.115172, 0.03198896, 0.160133, 0.00631478},
                            {4.0, 0.9, 0.4081422, 0.1285237, 0.5040927, 0.0718241},
                            {4.0, 1.0, 0.6909262, 0.3090738, 0.7855334, 0.2144666},
                            {16.0, 0.9, 0.4149474, 0.00024016, 0.5079389, 0.00013002},
                            {16.0, 1.0, 0.9036315, 0.09636849, 0.933294, 0.06670601}};
  ZScores scores;
  std::uint32_t seed = 0;
  const auto check = [&](const Case& c, double angle, bool above, double expected) {
    CAPTURE(c.depth);
    CAPTURE(c.albedo);
    CAPTURE(angle);
    CAPTURE(above);
    Scene scene = slab({c.depth, 0}, c.albedo, angle, above);
    scene.render.seed = ++seed;
    scores.add("slab", radiance(scene, 1024), expected, expected < 0.01 ? 0.2 : 0.01);
  };
  for (const Case& c : cases) {
    check(c, 0, true, c.reflected);
    check(c, 0, false, c.transmitted);
    check(c, 60, true, c.reflected60);
    check(c, 60, false, c.transmitted60);
  }
}

TEST_CASE("slab: thick beyond sight, at any density and from any distance, also behind glass that is not there") {
  constexpr double reflected[][3] = {
      {0.5, 0.1152259, 0.1601444}, {0.9, 0.4149475, 0.5079389}, {0.99, 0.7527207, 0.8151399}};
  ZScores scores;
  std::uint32_t seed = 100;
  for (const double density : {1e3, 1e5, 1e6})
    for (const auto& [albedo, straight, slanted] : reflected)
      for (const double angle : {0.0, 60.0}) {
        const bool far = seed % 2 == 0, glassy = seed % 3 == 0;
        CAPTURE(density);
        CAPTURE_BOUND(albedo);
        CAPTURE(angle);
        CAPTURE(far);
        CAPTURE(glassy);
        Scene scene = slab({density, 0}, albedo, angle, true, far ? 300 : 3);
        const Box<> box = std::get<Box<>>(std::get<Volume>(scene.objects[0].kind).boundary);
        if (glassy) add(scene, box, glass(1));
        scene.render.seed = ++seed;
        scores.add("thick slab", radiance(scene, 1024), angle == 0 ? straight : slanted, 5e-3);
      }
}

TEST_CASE("slab: the published cases of MCML") {
  // L. Wang, S. Jacques, L. Zheng, MCML, Computer Methods and Programs in Biomedicine 47 (1995), tables 1 and 2.
  ZScores scores;
  Scene thin = slab({100 * 0.02, 0.75}, 0.9, 0, true);
  scores.add("reflected", radiance(thin, 8192), 0.09739464, 1e-3);
  thin = slab({100 * 0.02, 0.75}, 0.9, 0, false);
  thin.render.seed = 1;
  scores.add("transmitted", radiance(thin, 4096), 0.6609577, 1e-3);
  Scene glassy = slab({1000, 0}, 0.9, 0, true);
  const Box<> box = std::get<Box<>>(std::get<Volume>(glassy.objects[0].kind).boundary);
  add(glassy, box, glass(1.5));
  glassy.render.seed = 2;
  scores.add("behind glass", radiance(glassy, 4096), 0.2599186, 1e-3);
}

}  // namespace tyndall::test::media_slow_test
