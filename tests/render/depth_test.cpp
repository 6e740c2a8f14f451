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

/// A wall point sees the light under the share f of its cosine-weighted sky, and the wall itself under the rest. depth:
/// the number of events after which light counts at most.
double wall_radiance(double rho, double light, int depth = 1000000) {
  const double f = light * light;
  return rho * f * (1 - std::pow(rho * (1 - f), depth)) / (1 - rho * (1 - f));
}

FilmTotals totals_of(const Scene& scene, int spp) { return totals(film_of(scene, spp)); }

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

TEST_CASE("depth: light counts after at most max_depth events; the rest is cut and counted") {
  ZScores scores;
  for (const double rho : {0.5, 0.95})
    for (const int depth : {1, 2, 5, 10, 50}) {
      CAPTURE(rho);
      CAPTURE(depth);
      const double light = 0.4, f = light * light;
      Scene scene = integrating_sphere(rho, light);
      scene.render.max_depth = depth;
      scene.render.seed = static_cast<std::uint32_t>(depth);
      const Film film = film_of(scene, 1024);
      std::vector<double> cut;
      for (const FilmPixel& pixel : film.pixels) cut.push_back(pixel.truncated / 1024.0);
      scores.add("truncated sum", estimate(channel_of(film)), wall_radiance(rho, light, depth), 0.01);
      // Roulette starts below an eighth of the full throughput: until then a path is cut if it never met the light.
      if (std::pow(rho, depth - 1) * 8 >= 1) scores.add("cut", estimate(cut), std::pow(1 - f, depth), 0.02);
    }
}

TEST_CASE("depth 1: a matt plane shows the sky, and paths that would go on are cut") {
  // The sky is linear in y, so one bounce sees it at the mean cosine, 2/3 for density cos/π.
  Scene scene = white_room();
  scene.background = Gradient{};
  scene.render.max_depth = 1;
  add(scene, Quad<>{{-100, 0, -100}, {0, 0, 200}, {200, 0, 0}}, lambertian(1));
  aim(scene, {0, 3, 1}, {0, 0, 0});
  const Film film = film_of(scene, 256);
  for (const double blue : channel_of(film, &Vec3f::z)) REQUIRE(blue == doctest::Approx(1).epsilon(1e-6).scale(0));
  ZScores scores;
  scores.add("red", estimate(channel_of(film, &Vec3f::x)), 0.5833333333333333, 1e-3);
  scores.add("green", estimate(channel_of(film, &Vec3f::y)), 0.75, 1e-3);
  CHECK(totals(film).truncated == 0);
}

TEST_CASE("depth: glass, media and metal are events; a medium's boundary is none") {
  Scene scene = white_room();
  aim(scene, {0, 0, 5}, {0, 0, 0});
  const auto seen_with = [&](int depth) {
    scene.render.max_depth = depth;
    return totals_of(scene, 1);
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
