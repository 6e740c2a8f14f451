#include "core/targets/kernels.h"
#include "tests/support/prepared.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

namespace tyndall::test::interior_test {

namespace {

/// Fraction of the sky's light that comes through the middle of a scene, seen along z from 10 sizes away.
double seen_through(const Kernels& kernels, Scene scene, Vec3d middle, double size) {
  scene.width = scene.height = 16;
  scene.background = Vec3d{1, 1, 1};
  scene.camera = {.look_from = middle + Vec3d{0, 0, 10 * size}, .look_at = middle, .vfov = 0.01};
  const RenderScene compiled = compile(scene);
  Film film = make_film(16, 16, {0, 0, 16, 16}, 0, compiled.film_quantum);
  const SceneViewOf view(compiled);
  TileCounts counts;
  kernels.render_tile(view.view(), {film.region, 1, 0, 0, 64}, film.quantum, film.pixels.data(), counts);
  CHECK(totals(film).rejected == 0);
  double sum = 0;
  for (const FilmPixel& pixel : film.pixels) sum += static_cast<double>(mean(film, pixel).x) / 256;
  return sum;
}

/// Smoke that absorbs only, so that what comes through is exp(-density · length).
Object smoke(std::variant<Sphere<>, Box<>> boundary, double density, Transform transform = {}) {
  return {"", Volume{boundary, {}, {density, 0}, Vec3d{0, 0, 0}}, std::move(transform)};
}

template <class Shape>
Object matched_glass(Shape shape, Transform transform = {}) {
  return {"", Solid3d{shape, 0}, std::move(transform)};
}

constexpr double samples = 16 * 16 * 64;
constexpr double passing = 0.36787944117144233;  // exp(-1)

}  // namespace

TEST_CASE("interior: smoke in matched glass of its very shape absorbs as smoke alone, at every scale and place") {
  for (const double size : {1e-6, 1e-3, 1.0, 1e3, 1e6})
    for (const Vec3d middle : {Vec3d{0, 0, 0}, Vec3d{1000 * size, -300 * size, 77 * size}}) {
      const Vec3d half{size, size, size};
      const Sphere<> ball{middle, size, {}};
      const Box<> box{-half, half};
      const Transform move{RotateY{90}, Translate{middle}};
      Scene glass;
      glass.materials = {{"glass", Vec3d{1, 1, 1}, Dielectric<>{1}}};
      const double density = 0.5 / size;  // the diameter is one mean free path
      for (int i = 0; i < 5; ++i) {
        Scene scene = glass;
        if (i == 0) scene.objects = {smoke(ball, density)};
        if (i == 1) scene.objects = {matched_glass(ball), smoke(ball, density)};
        if (i == 2) scene.objects = {matched_glass(box, move), smoke(box, density, move)};
        if (i == 3)
          scene.objects = {smoke(ball, density / 4), smoke(box, density * 3 / 4, move)};  // overlapping: they add
        if (i == 4) scene.objects = {matched_glass(ball), smoke(ball, density / 2), smoke(ball, density / 2)};
        for (const Kernels& kernels : available_kernels()) {
          CAPTURE(std::string(kernels.isa));
          CAPTURE(size);
          CAPTURE(i);
          const double sigma = std::sqrt(passing * (1 - passing) / samples);
          CHECK(std::abs(seen_through(kernels, scene, middle, size) - passing) < 4.5 * sigma);
        }
      }
    }
}

TEST_CASE("interior: a medium without density, or thinner than a sample can meet, is invisible to the last bit") {
  for (const double density : {0.0, 1e-30}) {
    Scene scene;
    scene.objects = {smoke(Sphere<>{{0, 0, 0}, 1, {}}, density)};
    for (const Kernels& kernels : available_kernels()) CHECK(seen_through(kernels, scene, {}, 1) == 1.0);
  }
}

TEST_CASE("interior: the camera may be inside; what is behind it does not absorb") {
  Scene scene;
  scene.objects = {smoke(Sphere<>{{0, 0, 10}, 1, {}}, 1)};  // the camera is at (0, 0, 10)
  for (const Kernels& kernels : available_kernels()) {
    const double sigma = std::sqrt(passing * (1 - passing) / samples);
    CHECK(std::abs(seen_through(kernels, scene, {}, 1) - passing) < 4.5 * sigma);
    Scene dark = scene;
    std::get<Volume>(dark.objects[0].kind).medium.density = 1e6;  // every path is absorbed at once
    CHECK(seen_through(kernels, dark, {}, 1) < 1e-3);
  }
}

}  // namespace tyndall::test::interior_test
