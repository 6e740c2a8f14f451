#include "core/files/film_files.h"

#include "core/render/render.h"
#include "tests/support/pictures.h"

#include <doctest/doctest.h>

#include <cmath>

namespace tyndall::test::layers_test {

TEST_CASE("layers: the variance of pixels is what the picture's estimated error is made of") {
  const auto scene = prepare(test::small_scene("cornell-box", 16, 16, 1));
  RenderOptions options;
  options.spp = 8;
  const RenderResult result = render(*scene, options);
  const std::vector<Layer> layers = layers_of(*scene, result.film, available_kernels().front());
  REQUIRE(layers.size() == 4);
  CHECK(layers[3].name == "Variance");
  REQUIRE(layers[3].values.size() == 3 * result.film.pixels.size());
  for (std::size_t i = 0; i < result.film.pixels.size(); ++i) {
    const FilmPixel& pixel = result.film.pixels[i];
    const Vec3f apart = half_mean(result.film, pixel, 0) - half_mean(result.film, pixel, 1);
    CHECK(layers[3].values[3 * i + 1] == doctest::Approx(apart.y * apart.y / 4).epsilon(1e-4).scale(0));
  }
}

TEST_CASE("layers: without a sample in each half the variance is not known") {
  const auto scene = prepare(test::small_scene("cornell-box", 4, 4, 1));
  RenderOptions options;
  options.spp = 1;
  const Layer variance = layers_of(*scene, render(*scene, options).film, available_kernels().front()).back();
  for (const float v : variance.values) CHECK(std::isinf(v));
}

TEST_CASE("layers: what sees nothing is infinitely far") {
  Scene scene;
  scene.width = scene.height = 2;
  const auto empty = prepare(scene);
  RenderOptions options;
  options.spp = 1;
  const Layer depth = layers_of(*empty, render(*empty, options).film, available_kernels().front())[2];
  CHECK(depth.name == "Depth");
  for (const float v : depth.values) CHECK(std::isinf(v));
}

}  // namespace tyndall::test::layers_test
