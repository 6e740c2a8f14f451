#include "tests/support/probe.h"

#include <doctest/doctest.h>

/// Paths that end because of max_depth, and paths that roulette ends at random.
namespace tyndall::test::depth_test {

namespace {

/// A light of radius `light` in the middle of a matt sphere of radius 1, seen from between them towards the wall.
Scene integrating_sphere(double rho, double light) {
  Scene scene = dark_room();
  add(scene, sphere({0, 0, 0}, 1), lambertian(rho));
  add(scene, sphere({0, 0, 0}, light), lamp(1));
  aim(scene, {0, 0.2, 0.95 * light + 0.05}, {0, 0.5, 1});
  return scene;
}

/// A wall point sees the light under the share f of its cosine-weighted sky, and the wall itself under the rest.
double wall_radiance(double rho, double light) {
  const double f = light * light;
  return rho * f / (1 - rho * (1 - f));
}

}  // namespace

TEST_CASE("roulette: a path's brightest channel decides how likely it ends") {
  Scene scene = integrating_sphere(0.5, 0.5);
  scene.materials[0].colour = Vec3d{0.9, 0.2, 0.02};
  const Film film = film_of(scene, 4096);
  ZScores scores;
  scores.add("red", estimate(channel_of(film, &Vec3f::x)), wall_radiance(0.9, 0.5), 3e-3);
  scores.add("green", estimate(channel_of(film, &Vec3f::y)), wall_radiance(0.2, 0.5), 3e-3);
  scores.add("blue", estimate(channel_of(film, &Vec3f::z)), wall_radiance(0.02, 0.5), 3e-3);
}

TEST_CASE("depth: the rest is cut and counted: what light counts is a known answer of verify") {
  ZScores scores;
  for (const auto& [rho, depth] : {std::pair{0.5, 1}, {0.5, 2}, {0.95, 5}, {0.95, 10}}) {
    const double light = 0.4, f = light * light;
    REQUIRE(std::pow(rho, depth - 1) * 8 >= 1);  // until roulette starts a path is cut if it never met the light
    Scene scene = integrating_sphere(rho, light);
    scene.render.max_depth = depth;
    const Film film = film_of(scene, 1024);
    std::vector<double> cut;
    for (const FilmPixel& pixel : film.pixels) cut.push_back(pixel.truncated / 1024.0);
    scores.add("cut", estimate(cut), std::pow(1 - f, depth), 0.02);
  }
}

TEST_CASE("depth: glass, media and metal are events; a medium's boundary is none") {
  Scene scene = white_room();
  aim(scene, {0, 0, 5}, {0, 0, 0});
  const auto seen_with = [&](int depth) {
    scene.render.max_depth = depth;
    return totals(film_of(scene, 1));
  };
  add_medium(scene, sphere({0, 0, 0}, 1), {1e-20, 0}, 1);
  CHECK(seen_with(0).truncated == 0);
  add(scene, Quad<>{{-9, -9, 2}, {18, 0, 0}, {0, 18, 0}}, glass(1));
  CHECK(seen_with(0).truncated == 1024);
  CHECK(seen_with(1).truncated == 0);
  add(scene, sphere({0, 0, 0}, 0.5), glass(1));
  CHECK(seen_with(2).truncated == 1024);
  CHECK(seen_with(3).truncated == 0);
  add(scene, Quad<>{{-9, -9, -2}, {18, 0, 0}, {0, 18, 0}}, metal(1, 0));
  CHECK(seen_with(6).truncated == 1024);
  CHECK(seen_with(7).truncated == 0);
}

}  // namespace tyndall::test::depth_test
