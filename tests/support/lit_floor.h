#pragma once
#include "tests/support/pictures.h"
#include "tests/support/probe.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

/// A floor under a lamp, and the check that chains find there the light that scattering alone finds in the end.
namespace tyndall::test {

/// A floor, and a lamp above it.
inline Scene lit_floor(double lamp_radius, Vec3d lamp_center, double radiance) {
  Scene scene = dark_room();
  scene.render.integrator = Integrator::mis;
  add(scene, Quad<>{{-6, 0, -6}, {12, 0, 0}, {0, 0, 12}}, lambertian(0.73));
  add(scene, sphere(lamp_center, lamp_radius), lamp(radiance));
  return scene;
}

/// The same point by chains and by scattering alone: equal, and with far less noise.
inline void check_against_scattering(const std::string& name, Scene scene, double less_noise) {
  CAPTURE(name);
  REQUIRE(compile(scene).chains.ball.size() > 0);
  const Estimate chains = radiance(scene, 64);
  scene.render.caustics = Caustics::scatter;
  REQUIRE(compile(scene).chains.ball.empty());
  const Estimate chance = radiance(scene, 1024);
  CAPTURE(chains.mean);
  CAPTURE(chains.error);
  CAPTURE(chance.mean);
  CAPTURE(chance.error);
  CHECK(std::abs(chains.mean - chance.mean) < 4 * std::hypot(chains.error, chance.error));
  CHECK(chains.error < less_noise * chance.error * 4);  // sixteen times fewer samples
}

}  // namespace tyndall::test
