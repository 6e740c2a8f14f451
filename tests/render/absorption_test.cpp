#include "tests/support/probe.h"

#include <doctest/doctest.h>

/// Media that only absorb, whose paths carry what passes (flight.h).
namespace tyndall::test::absorption_test {

namespace {

/// A ray through the middle of spheres of media of radius 1, with the white sky behind them.
Scene through_medium(const std::vector<double>& densities, Integrator integrator) {
  Scene scene = white_room();
  scene.render.integrator = integrator;
  for (const double density : densities) add_medium(scene, sphere({0, 0, 0}, 1), {density, 0}, 0);
  aim(scene, {0, 0, 5}, {0, 0, 0});
  return scene;
}

/// How many single samples are not one of these values, within 1e-6 of it.
int count_others(const Scene& scene, const std::vector<double>& values, const std::string& isa = "") {
  const Film film = film_of(scene, 1, isa);
  return static_cast<int>(std::count_if(film.pixels.begin(), film.pixels.end(), [&](const FilmPixel& pixel) {
    const double x = static_cast<double>(mean(film, pixel).x);
    return std::none_of(values.begin(), values.end(), [x](double v) { return std::abs(x - v) <= 1e-6 * v; });
  }));
}

/// mis finds the light that `nee` finds, where media ends paths by chance, and with this fraction of its noise.
void check_same_light(const Scene& scene, double noise) {
  const Estimate mis = over_seeds(scene, Integrator::mis, 64), nee = over_seeds(scene, Integrator::nee, 256);
  check_agree(mis, nee);
  CHECK(mis.error < noise * 2 * nee.error);
}

}  // namespace

TEST_CASE("smoke: where much passes, every path carries it, without noise") {
  for (const char* isa : {"", "scalar"}) {
    CHECK(count_others(through_medium({0.3}, Integrator::mis), {std::exp(-0.6)}, isa) == 0);
    CHECK(count_others(through_medium({0.3, 0.9}, Integrator::mis), {std::exp(-2.4)}, isa) == 0);
  }
  for (const Integrator integrator : {Integrator::path, Integrator::nee})
    CHECK(count_others(through_medium({0.3}, integrator), {0, 1}) == 0);
}

TEST_CASE("smoke: where little passes, some paths carry an eighth") {
  Scene scene = through_medium({2.5}, Integrator::mis);
  CHECK(count_others(scene, {0, 0.125}) == 0);
  ZScores scores;
  scores.add("exp(-5)", radiance(scene, 512), std::exp(-5));
  scene = through_medium({2.5, 0.5}, Integrator::mis);
  scores.add("exp(-6)", radiance(scene, 512), std::exp(-6));
}

TEST_CASE("smoke: hides no light from a lamp in fog") {
  Scene scene = dark_room();
  add(scene, Quad<>{{-6, 0, -6}, {0, 0, 12}, {12, 0, 0}}, lambertian(0.7));
  add(scene, sphere({0, 1.5, 1}, 0.02), lamp(3000));
  add_medium(scene, sphere({0, 1.5, 1}, 1.5), {0.5, 0}, 0.9);
  add_medium(scene, sphere({0.5, 1.5, 1}, 1.2), {0.6, 0}, 0);
  scene.camera = {.look_from = {0, 3, 8}, .look_at = {1, 1, 0}, .vfov = 10};
  scene.render.integrator = Integrator::mis;
  CHECK(compile(scene).near.light.size() == 1);
  check_same_light(scene, 0.5);
}

TEST_CASE("smoke: hides no light that comes through a ball of glass") {
  Scene scene = dark_room();
  add(scene, Quad<>{{-6, 0, -6}, {0, 0, 12}, {12, 0, 0}}, lambertian(0.7));
  add(scene, sphere({0, 1.2, 0}, 1), glass(1.5));
  add(scene, sphere({0.3, 1.3, 0}, 0.1), lamp(300));
  add_medium(scene, sphere({0, 1.2, 0}, 2.5), {0.5, 0}, 0);
  scene.camera = {.look_from = {0, 4, 6}, .look_at = {0, 0, 1}, .vfov = 20};
  scene.render.integrator = Integrator::mis;
  CHECK(compile(scene).specular.sphere.size() == 1);
  check_same_light(scene, 0.5);
}

}  // namespace tyndall::test::absorption_test
