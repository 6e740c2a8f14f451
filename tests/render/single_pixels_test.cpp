#include "core/render/single_pixels.h"

#include "tests/support/pictures.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

/// Levels of single pixels, from samples of their own.
namespace tyndall::test::single_pixels_test {

namespace {

RenderScene small(const char* name, int width = 40, int height = 30) {
  return compile(small_scene(name, width, height, 1));
}

Film film_of(const RenderScene& scene, Region region, std::uint32_t spp) {
  return render(scene, {.region = region, .spp = spp}).film;
}

}  // namespace

TEST_CASE("levels: those of the film, within their errors, from other samples") {
  for (const char* name : {"cornell-box", "showroom"}) {  // the first one shares second vertices
    CAPTURE(name);
    const Ready ready(small(name));
    const Region region{7, 5, 31, 22};
    const Film film = film_of(ready.scene, region, PixelLevels::samples);
    const std::vector<std::size_t> pixels{0, 100, 207, film.pixels.size() - 1};
    PixelLevels levels;
    const std::vector<Vec3f> found = levels.of(pixels, film, ready.engine, false);
    REQUIRE(found.size() == pixels.size());
    double worst = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const FilmPixel& pixel = film.pixels[pixels[i]];
      const auto expected = static_cast<double>(mean(film, pixel).y), level = static_cast<double>(found[i].y);
      CHECK(level == doctest::Approx(expected).epsilon(0.05).scale(0.01));
      worst = std::max(worst, std::abs(level - expected));
    }
    CHECK(worst > 0);
  }
}

TEST_CASE("levels: the same bits for any number of threads, any order of questions and any region") {
  const Ready one(small("showroom"), 1), three(small("showroom"), 3);
  const Film whole = film_of(one.scene, {0, 0, 40, 30}, 2), part = film_of(one.scene, {8, 4, 24, 20}, 2);
  PixelLevels first, second, third;
  const auto at_once = first.of({whole.index(9, 9), whole.index(20, 15)}, whole, one.engine, false);
  const auto later = second.of({whole.index(20, 15)}, whole, three.engine, false);
  const auto again = second.of({whole.index(9, 9), whole.index(20, 15)}, whole, three.engine, false);
  const auto in_part = third.of({part.index(9, 9), part.index(20, 15)}, part, three.engine, false);
  REQUIRE(at_once.size() == 2);
  REQUIRE(later.size() == 1);
  CHECK(later[0] == at_once[1]);
  CHECK(again == at_once);
  CHECK(in_part == at_once);
}

TEST_CASE("levels: none when it is given up, and they are found when asked again") {
  const Ready ready(small("cornell-box"));
  const Film film = film_of(ready.scene, {0, 0, 40, 30}, 2);
  PixelLevels levels;
  CHECK(levels.of({5, 6}, film, ready.engine, true).empty());
  const auto found = levels.of({5, 6}, film, ready.engine, false);
  CHECK(found.size() == 2);
  CHECK(levels.of({6, 5}, film, ready.engine, true).size() == 2);  // they are known
}

TEST_CASE("levels: those of pixels with subpixel lights are known, where these pixels are few") {
  const Ready ready(small("stress-bulb", 111, 83));
  const Film film = film_of(ready.scene, {0, 0, 111, 83}, 4), part = film_of(ready.scene, {53, 30, 90, 60}, 4);
  const std::vector<std::size_t> pixels = pixels_with_subpixel_lights(ready.view.view(), film);
  REQUIRE(pixels.size() > 4);
  CHECK(std::is_sorted(pixels.begin(), pixels.end()));
  CHECK(std::count(pixels.begin(), pixels.end(), film.index(53, 35)) == 1);
  const std::vector<std::size_t> in_part = pixels_with_subpixel_lights(ready.view.view(), part);
  CHECK(in_part.size() < pixels.size());
  CHECK(std::count(in_part.begin(), in_part.end(), part.index(53, 35)) == 1);
  // Both halves of one pixel met the light, which one sample in 17 does.
  PixelLevels levels;
  const std::atomic<bool> never = false;
  const ErrorEstimate by_noise = estimate_error(film, nullptr, levels_of(film, ready.engine, levels, never));
  const ErrorEstimate known = estimate_error(film, ready.engine, levels, never);
  CHECK(known.relative_error > 1.1 * by_noise.relative_error);
  const Ready plain(small("cornell-box"), 1);
  CHECK(pixels_with_subpixel_lights(plain.view.view(), film).empty());
}

TEST_CASE("levels: the error of a picture with a light that is smaller than a pixel") {
  // Single samples meet the light by chance: from the film alone it looks like a rare path.
  const RenderScene compiled = small("stress-light-and-fuzz", 111, 83);
  const Film film = film_of(compiled, {0, 0, 111, 83}, 4);
  const Kernels kernels = *choose_kernels("");
  const double alone = estimate_error(film).relative_error,
               known = estimate_error(compiled, kernels, film).relative_error;
  CHECK(alone > 5 * known);
  CHECK(estimate_error(compiled, kernels, film, 1).relative_error == known);
}

}  // namespace tyndall::test::single_pixels_test
