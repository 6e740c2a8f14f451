#include "tests/support/probe.h"

#include <doctest/doctest.h>

/// Several media at once, and media of no density; known answers of one are cases of "tyndall verify".
namespace tyndall::test::media_test {

TEST_CASE("fog: media that overlap, or lie in a row, add up, in density and in colour") {
  ZScores scores;
  Scene absorbing = white_room();
  add_medium(absorbing, sphere({0, 0, 0}, 1), {0.7, 0}, 0);
  add_medium(absorbing, Box<>{{-0.5, -1, -2}, {0.5, 1, 0.25}}, {0.4, 0}, 0);
  aim(absorbing, {0, 0, 5}, {0, 0, 0});
  scores.add("absorption", radiance(absorbing, 512), std::exp(-0.7 * 2 - 0.4 * 2.25));
  // Two equal spheres, one black, one white, are one sphere of twice the density and albedo 1/2.
  Scene mixed = sphere_seen_at(0, 1);
  mixed.render.seed = 5;
  add_medium(mixed, sphere({0, 0, 0}, 1), {0.5, 0}, 1);
  add_medium(mixed, sphere({0, 0, 0}, 1), {0.5, 0}, 0);
  scores.add("equal balls", radiance(mixed, 512), 0.41049922560061036, 5e-3);
  // A sphere that is half one, half another medium of the same kind.
  Scene split = sphere_seen_at(0.6, 1);
  split.render.seed = 6;
  add_medium(split, sphere({0, 0, 0}, 1), {1.5, 0}, 0.9);
  add_medium(split, sphere({0, 0, 0}, 1), {0.5, 0}, 0.9);
  scores.add("layers", radiance(split, 512), 0.7518521509111393, 5e-3);
  Scene row = white_room();
  for (int i = 0; i < 10; ++i) add_medium(row, sphere({0, 0, 3.0 * i}, 1), {0.05, 0}, 0);
  aim(row, {0, 0, 50}, {0, 0, 0});
  scores.add("row", radiance(row, 512), std::exp(-1.0), 0.02);
}

TEST_CASE("fog: without density it is not there") {
  Scene scene = white_room();
  scene.background = Gradient{};
  scene.camera = {.look_from = {0, 0.5, 3}, .look_at = {0, 0, 0}};
  add(scene, sphere({0, 0, 0}, 1), lambertian(0.5));
  const std::vector<float> clear = resolve(film_of(scene, 4));
  for (const double density : {0.0, 1e-38, 1e-30}) {
    Scene fog = scene;
    add_medium(fog, sphere({0, 0, 0}, 2), {density, 0}, 0.5);
    CHECK(resolve(film_of(fog, 4)) == clear);
  }
}

}  // namespace tyndall::test::media_test
