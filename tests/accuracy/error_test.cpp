#include "core/accuracy/error.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>

namespace tyndall::test::error_test {

TEST_CASE("film mean: by hand for two pixels that show different things") {
  Film film = make_film(2, 1, {0, 0, 2, 1}, 0, 8);
  const auto add = [&](int x, std::uint32_t half, float red) {
    add_sample(film.at(x, 0), half, {red, 2, 3}, 1 / film.quantum);
    ++film.at(x, 0).taken;
  };
  add(0, 0, 1), add(0, 1, 4), add(1, 0, 7);
  CHECK(film_mean(film).error == std::numeric_limits<double>::infinity());
  add(1, 1, 7);
  CHECK(film_mean(film).mean == doctest::Approx((2.5 + 7 + 2 + 2 + 3 + 3) / 6));
  CHECK(film_mean(film).error ==
        doctest::Approx(0.5 * std::sqrt(0.25)));  // halves 2 and 3 in one pixel, alike in the other
}

TEST_CASE("image error: is what was computed by hand") {
  const ImageError error = image_error({0.2f, 0.5f, 1.0f}, {0.1f, 0.5f, 0.5f});
  CHECK(error.mse == doctest::Approx((0.01 + 0.25) / 3).epsilon(1e-6).scale(0));
  CHECK(error.rmse == doctest::Approx(0.294392).epsilon(1e-5).scale(0));
  CHECK(error.rel_mse == doctest::Approx((0.01 / 0.02 + 0.25 / 0.26) / 3).epsilon(1e-6).scale(0));
  // sRGB: 0.484529 - 0.349190 and 1 - 0.735357.
  CHECK(error.psnr ==
        doctest::Approx(-10 * std::log10((0.135339 * 0.135339 + 0.264643 * 0.264643) / 3)).epsilon(1e-5).scale(0));
  CHECK(error.mean_image.x == doctest::Approx(0.2));
  CHECK(error.mean_reference.z == doctest::Approx(0.5));
}

TEST_CASE("image error: means run over all pixels, channel by channel") {
  const ImageError error = image_error({1, 2, 3, 3, 4, 7}, {1, 2, 3, 3, 4, 5});
  CHECK(error.mean_image == Vec3d{2, 3, 5});
  CHECK(error.mean_reference == Vec3d{2, 3, 4});
  CHECK(error.mse == doctest::Approx(4.0 / 6));
  CHECK(error.psnr == std::numeric_limits<double>::infinity());  // the same when clipped to [0, 1]
  CHECK(image_error({-3, 0, 0}, {0, -1, 0}).psnr == std::numeric_limits<double>::infinity());
}

TEST_CASE("image error: of equal images it is 0, and what is not a number is not hidden") {
  const std::vector<float> image = {0.1f, 0.2f, 0.3f};
  CHECK(image_error(image, image).mse == 0);
  CHECK(image_error(image, image).psnr == std::numeric_limits<double>::infinity());
  const ImageError bad = image_error({std::numeric_limits<float>::quiet_NaN(), 0, 0}, image);
  CHECK(std::isnan(bad.mse));
  CHECK(std::isnan(bad.psnr));
}

TEST_CASE("relMSE alone is that of all the errors") {
  std::vector<float> image, reference;
  for (int i = 0; i < 300; ++i) {
    image.push_back(0.01f * static_cast<float>(i % 37));
    reference.push_back(0.02f * static_cast<float>(i % 11));
  }
  CHECK(relative_mse(image, reference) == image_error(image, reference).rel_mse);
  CHECK(relative_mse(image, image) == 0);
}

TEST_CASE("the error of each pixel against a reference: by the reference's size, spread over 7 x 7") {
  constexpr int columns = 20, rows = 15;
  constexpr auto at = [](int x, int y) { return static_cast<std::size_t>(3 * (y * columns + x)); };
  std::vector<float> reference(3 * columns * rows, 1.0f), image = reference;
  for (std::size_t k = 0; k < 3; ++k) image[at(10, 7) + k] = 1.5f;
  const std::vector<float> errors = pixel_relative_error(image, reference, columns, rows);
  REQUIRE(errors.size() == columns * rows);
  const double peak = std::sqrt(0.25 / 1.01 / 49);
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      const bool near = std::abs(x - 10) <= 3 && std::abs(y - 7) <= 3;
      CHECK(errors[at(x, y) / 3] == doctest::Approx(near ? peak : 0.0));
    }
}

TEST_CASE("error outside [0, 1]: only of values that one of both has there, in both directions") {
  const OutsideError error = outside_error({0.2f, 3.0f, 1.0f, -0.5f, 0.0f, 1.0f}, {0.9f, 2.0f, 1.5f, 0.0f, 1.0f, 1.0f});
  CHECK(error.values == 3);
  CHECK(error.rel_mse == doctest::Approx((1 / 4.01 + 0.25 / 2.26 + 0.25 / 0.01) / 3).epsilon(1e-6).scale(0));
  CHECK(outside_error({0, 0.5f, 1}, {1, 0, 0}).values == 0);
  CHECK(outside_error({0, 0.5f, 1}, {1, 0, 0}).rel_mse == 0);
  const float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  CHECK(outside_error({nan, infinity, 2}, {3, infinity, 2}).values == 1);
}

TEST_CASE("not finite: how many pixels, and the first of them with its value") {
  const float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  LinearImage image{3, 2, std::vector<float>(18, 0.5f)};
  CHECK(not_finite_text(image).empty());
  CHECK(is_finite(image, 5));
  image.rgb[3 * 5 + 2] = -infinity;
  CHECK(not_finite_text(image) == "1 of 6 pixels is not finite, the first at 2,1 (blue is -inf)");
  CHECK_FALSE(is_finite(image, 5));
  image.rgb[3 * 1 + 1] = nan, image.rgb[3 * 1 + 2] = nan;  // one pixel, whatever its channels
  CHECK(not_finite_text(image) == "2 of 6 pixels are not finite, the first at 1,0 (green is nan)");
  image.frame = ImageFrame{{0, 0, 9, 9}, {4, -3, 7, -1}};  // an EXR's data window: the place is the picture's
  CHECK(not_finite_text(image) == "2 of 6 pixels are not finite, the first at 5,-3 (green is nan)");
}

namespace {

constexpr int edge = 128;

/// Exponential noise around a ramp, times `factor` in the right half.
Film noisy_film(unsigned seed, float factor) {
  Film film = make_film(edge, edge, {0, 0, edge, edge}, 0, 64);
  std::mt19937 engine(seed);
  std::exponential_distribution<float> noise;
  for (int i = 0; i < edge * edge; ++i) {
    FilmPixel& pixel = film.pixels[static_cast<std::size_t>(i)];
    const float truth = (1 + static_cast<float>(i % edge)) * (i % edge < edge / 2 ? 1.0f : factor) / edge;
    for (std::uint32_t s = 0; s < 16; ++s) {
      const float v = truth * noise(engine);
      add_sample(pixel, s & 1, {v, v, v}, 1 / film.quantum);
    }
    pixel.taken = 16;
  }
  return film;
}

}  // namespace

TEST_CASE("block scores: films that differ by noise alone pass, ten percent more in half of the picture fails") {
  const Film plain = noisy_film(1, 1);
  for (unsigned seed = 2; seed < 6; ++seed) {
    const BlockScores same = block_scores(plain, noisy_film(seed, 1));
    CHECK(same.blocks == 64);
    CHECK(same.mean_square > 0.4);
    CHECK(same.noise());
  }
  const BlockScores biased = block_scores(noisy_film(1, 1), noisy_film(2, 1.1f));
  CHECK_FALSE(biased.noise());
  CHECK(biased.mean_square > 2);
}

TEST_CASE("block scores: films that are equal, of other regions, with empty halves, or different without noise") {
  const Film film = noisy_film(1, 1);
  CHECK(block_scores(film, film).mean_square == 0);
  CHECK(block_scores(film, film).noise());
  Film part = make_film(edge, edge, {0, 0, edge, edge / 2}, 0, 64);
  CHECK(block_scores(film, part).blocks == 0);
  CHECK(block_scores(film, make_film(edge, edge, film.region, 0, 64)).blocks == 0);
  Film flat = make_film(8, 8, {0, 0, 8, 8}, 0, 64), brighter = flat;
  for (std::size_t i = 0; i < 64; ++i)
    for (std::uint32_t s = 0; s < 2; ++s) {
      add_sample(flat.pixels[i], s, {1, 1, 1}, 1 / flat.quantum), ++flat.pixels[i].taken;
      add_sample(brighter.pixels[i], s, {1.5f, 1.5f, 1.5f}, 1 / flat.quantum), ++brighter.pixels[i].taken;
    }
  CHECK(block_scores(flat, flat).noise());
  CHECK_FALSE(block_scores(flat, brighter).noise());
}

}  // namespace tyndall::test::error_test
