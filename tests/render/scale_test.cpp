#include "tests/support/pictures.h"
#include "tests/support/probe.h"
#include "tests/support/scaled_scene.h"
#include "tests/support/thorough.h"

#include <doctest/doctest.h>

#include <cmath>

/// A scene gives the same picture in any unit of length and at any distance from the origin, because the renderer has
/// no fixed lengths, such as a least distance.
namespace tyndall::test::scale_test {

namespace {

constexpr int width = 24, height = 18;

Film small_film(Scene scene, const std::string& isa = "") {
  scene.width = width, scene.height = height;
  return film_of(scene, 2, isa);
}

/// Whether a scene has marble, whose pattern does not scale with the scene: its turbulence has cells of one unit.
bool has_own_length(const Scene& scene) {
  for (const Texture& texture : scene.textures) {
    const auto* noise = std::get_if<Noise<>>(&texture.kind);
    if (noise && noise->style == Noise<>::Style::marble) return true;
  }
  return false;
}

/// Spheres of all materials, media, a light and a turned box, in numbers that shifts by powers of two leave exact.
Scene shelf() {
  Scene scene = white_room();
  scene.background = Gradient{{0.2, 0.2, 0.25}, {0.5, 0.6, 0.8}};
  scene.camera = {.look_from = {0.5, 1.5, 5}, .look_at = {0, 0.5, 0}, .vfov = 40};
  scene.render.integrator = Integrator::mis;
  scene.render.sampler = SamplerKind::sobol;
  add(scene, Quad<>{{-4, 0, -4}, {8, 0, 0}, {0, 0, 8}}, lambertian(0.5));
  add(scene, sphere({-1.5, 0.5, 0}, 0.5), lambertian(0.7));
  add(scene, sphere({0, 0.5, 0.5}, 0.5), glass(1.5));
  add(scene, sphere({0, 0.5, 0.5}, -0.375), glass(1.5));
  add(scene, sphere({1.25, 0.5, 0}, 0.5), metal(0.8, 0.3));
  add(scene, Quad<>{{-1, 3, -1}, {2, 0, 0}, {0, 0, 2}}, lamp(4));
  add(scene, Box<>{{-0.5, 0, -0.5}, {0.5, 1.5, 0.5}}, lambertian(0.4), {RotateY{90}, Translate{{-1, 0, -1.5}}});
  add_medium(scene, Box<>{{-2, 0, -2}, {2, 2, 2}}, {0.25, 0.5}, 0.9);
  return scene;
}

}  // namespace

TEST_CASE("scale: every built-in scene is, bit for bit, the same picture in units 2^-20 to 2^20 times as long") {
  // A fixed least distance of 0.001 loses the glass of the small ones and makes acne on the large ones.
  int scenes = 0;
  for (const BuiltIn& built_in : built_in_scenes()) {
    const Scene scene = small_scene(built_in.name, width, height, 2);
    if (has_own_length(scene)) continue;
    const Film film = small_film(scene);
    CAPTURE(built_in.name);
    constexpr int exponents[] = {-20, 13, -13, 20};
    for (const int exponent : tried(exponents, 2)) {
      CAPTURE(exponent);
      CHECK(small_film(scaled(scene, std::ldexp(1.0, exponent))) == film);
    }
    ++scenes;
  }
  CHECK(scenes >= 40);
}

TEST_CASE("scale: the same on every instruction set, in any unit and far away, also from within glass and fog") {
  std::vector<Scene> scenes{shelf()};
  for (const Vec3d eye : {Vec3d{0.0625, 0.5, 0.9375}, Vec3d{0.25, 0.75, 0.5}, Vec3d{0.5, 1.5, 1.5}}) {
    scenes.push_back(shelf());  // in the shell, in the hollow, in the media
    scenes.back().camera = {.look_from = eye, .look_at = eye + Vec3d{-0.5, -0.25, -1}, .vfov = 40};
  }
  for (const Scene& scene : scenes)
    for (const Kernels& kernels : available_kernels()) {
      CAPTURE(kernels.isa);
      const Film film = small_film(scene, kernels.isa);
      CHECK(totals(film).rejected == 0);
      for (const int exponent : {-20, -13, -5, 5, 13, 20}) {
        CAPTURE(exponent);
        CHECK(small_film(scaled(scene, std::ldexp(1.0, exponent)), kernels.isa) == film);
      }
      for (const Vec3d direction : {Vec3d{131072, 0, 0}, Vec3d{-131072, 262144, 524288}, Vec3d{0, -0x1p30, 0}})
        CHECK(small_film(moved(scene, direction), kernels.isa) == film);
      CHECK_FALSE(small_film(moved(scene, {0.1, 0, 0}), kernels.isa) == small_film(scaled(scene, 1.1), kernels.isa));
    }
}

}  // namespace tyndall::test::scale_test
