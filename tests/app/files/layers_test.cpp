#include "app/files/layers.h"

#include "core/accuracy/error.h"
#include "core/render/render.h"
#include "tests/support/pictures.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace tyndall;

TEST_CASE("layers: the variance of pixels is what the picture's estimated error is made of") {
  const RenderScene scene = compile(test::small_scene("cornell-box", 16, 16, 1));
  RenderOptions options;
  options.spp = 8;
  const RenderResult result = render(scene, options);
  const std::vector<Layer> layers = layers_of(scene, result.film, available_kernels().front());
  REQUIRE(layers.size() == 4);
  CHECK(layers[3].name == "variance");
  const std::vector<float> mean = resolve(result.film);
  REQUIRE(layers[3].values.size() == mean.size());
  double sum = 0;
  for (std::size_t i = 0; i < mean.size(); ++i) {
    const auto m = static_cast<double>(mean[i]);
    sum += static_cast<double>(layers[3].values[i]) / (m * m + 0.01);
  }
  const double error = estimated_relative_error(result.film);
  CHECK(std::sqrt(sum / static_cast<double>(mean.size())) == doctest::Approx(error).epsilon(1e-5));
}

TEST_CASE("layers: without a sample in each half the variance is not known") {
  const RenderScene scene = compile(test::small_scene("cornell-box", 4, 4, 1));
  RenderOptions options;
  options.spp = 1;
  const Layer variance = layers_of(scene, render(scene, options).film, available_kernels().front()).back();
  for (const float v : variance.values) CHECK(std::isinf(v));
}
