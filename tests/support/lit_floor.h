#pragma once
#include "tests/support/pictures.h"
#include "tests/support/probe.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

/// A floor under a light, and the check that specular paths find there the light that scattering alone finds in the
/// end.
namespace tyndall::test {

/// A floor, and a light above it.
inline Scene lit_floor(double light_radius, Vec3d light_center, double radiance) {
  Scene scene = dark_room();
  scene.render.integrator = Integrator::mis;
  add(scene, Quad<>{{-6, 0, -6}, {12, 0, 0}, {0, 0, 12}}, lambertian(0.73));
  add(scene, sphere(light_center, light_radius), lamp(radiance));
  return scene;
}

/// The same point by specular paths and by scattering alone: equal, and with far less noise.
inline void check_against_scattering(const std::string& name, Scene scene, double less_noise) {
  CAPTURE(name);
  REQUIRE(compile(scene).specular.sphere.size() > 0);
  const Estimate by_specular_paths = radiance(scene, 64);
  scene.render.caustics = Caustics::scatter;
  REQUIRE(compile(scene).specular.sphere.empty());
  const Estimate chance = radiance(scene, 1024);
  check_agree(by_specular_paths, chance);
  CHECK(by_specular_paths.error < less_noise * chance.error * 4);  // sixteen times fewer samples
}

/// The same for `point` of the floor, seen by a camera with the scene's shutter.
inline void check_point_of_floor(const std::string& name, Scene scene, Vec3d point, double less_noise) {
  const double open = scene.camera.shutter_open, close = scene.camera.shutter_close;
  aim(scene, {0.3, 4, 6}, point);
  scene.camera.shutter_open = open, scene.camera.shutter_close = close;
  check_against_scattering(name, scene, less_noise);
}

/// A white floor in a white room, and a light as bright as all around it.
inline Scene furnace_with_floor() {
  Scene scene = white_room();
  scene.render.integrator = Integrator::mis;
  scene.camera = {.look_from = {0, 3, 7}, .look_at = {0, 1, 0}, .vfov = 40};
  add(scene, Quad<>{{-6, 0, -6}, {12, 0, 0}, {0, 0, 12}}, lambertian(1));
  add(scene, sphere({1.5, 4.5, 0.5}, 0.1), lamp(1));
  return scene;
}

/// Nothing of a furnace is to be seen: all is as bright as its walls.
inline void check_invisible(const Scene& furnace) {
  const Estimate all = radiance(furnace, 256);
  CHECK(std::abs(all.mean - 1) < 4 * all.error);
  CHECK(all.error < 0.002);
}

}  // namespace tyndall::test
