#include "app/report/film_difference.h"

#include "core/render/render.h"
#include "core/scene/load.h"

#include <doctest/doctest.h>

#include <cmath>

namespace tyndall::test::film_difference_test {
namespace {

Film film_of(double fuzz, std::uint32_t seed, std::uint32_t spp) {
  Scene scene = load_scene("showroom").scene;
  scene.width = 48, scene.height = 27, scene.render.seed = seed;
  for (Material& material : scene.materials)
    if (auto* metal = std::get_if<Metal<>>(&material.kind)) metal->fuzz = fuzz;
  RenderOptions options;
  options.spp = spp;
  options.threads = 1;
  return render(*prepare(scene), options).film;
}

/// Root mean square over pixels and channels of the difference of two pictures less the true one.
double true_error(const Film& a, const Film& b, const std::vector<float>& truth) {
  const std::vector<float> x = resolve(a), y = resolve(b);
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += std::pow(static_cast<double>(x[i] - y[i] - truth[i]), 2);
  return std::sqrt(sum / static_cast<double>(x.size()));
}

}  // namespace

TEST_CASE("film difference: its error is that of the difference, far below those of both pictures") {
  const Film truth_a = film_of(0.18, 1000, 1024), truth_b = film_of(0.20, 1000, 1024);
  std::vector<float> truth = resolve(truth_a);
  const std::vector<float> other = resolve(truth_b);
  for (std::size_t i = 0; i < truth.size(); ++i) truth[i] -= other[i];
  double stated = 0, measured = 0, two_seeds = 0, deviations = 0;
  const FilmDifference exact = film_difference(truth_a, truth_b);
  constexpr int seeds = 6;
  for (std::uint32_t seed = 0; seed < seeds; ++seed) {
    const Film a = film_of(0.18, seed, 16), b = film_of(0.20, seed, 16);
    const FilmDifference difference = film_difference(a, b);
    stated += std::pow(difference.rms_error, 2);
    measured += std::pow(true_error(a, b, truth), 2);
    two_seeds += std::pow(true_error(a, film_of(0.20, seed + 500, 16), truth), 2);
    deviations += std::pow((difference.mean - exact.mean) / difference.mean_error, 2);
  }
  CHECK(std::sqrt(stated / measured) > 0.8);
  CHECK(std::sqrt(stated / measured) < 1.25);
  CHECK(std::sqrt(two_seeds / measured) > 3);
  CHECK(deviations / seeds < 6);
  CHECK(deviations / seeds > 0.05);
}

TEST_CASE("film difference: equal films differ by nothing, and one sample states no error") {
  const Film film = film_of(0.2, 1, 4), single = film_of(0.2, 1, 1);
  CHECK(film_difference(film, film).rms == 0);
  CHECK(film_difference(film, film).rms_error == 0);
  const FilmDifference noise = film_difference(film_of(0.2, 1, 16), film_of(0.2, 2, 16));
  CHECK(noise.rms < noise.rms_error);  // the products of two halves have no bias
  CHECK(std::isinf(film_difference(single, single).rms_error));
}

}  // namespace tyndall::test::film_difference_test
