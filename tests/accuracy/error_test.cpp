#include "core/accuracy/error.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace tyndall;

namespace {

constexpr int width = 192, height = 128;

/// What the synthetic film would converge to: a ramp from nearly black to bright.
float truth(int x) { return 0.02f * std::exp2(static_cast<float>(x) / 20.0f); }

std::vector<float> true_image() {
  std::vector<float> image;
  for (int i = 0; i < width * height; ++i) image.insert(image.end(), 3, truth(i % width));
  return image;
}

/// Samples with exponential noise (standard deviation = mean), `power` samples averaged into one in the right half.
Film noisy_film(std::uint32_t spp, int right_divisor) {
  Film film = make_film(width, height, {0, 0, width, height}, 0, 64);
  std::mt19937 engine(3);
  std::exponential_distribution<float> noise;
  for (int i = 0; i < width * height; ++i) {
    const int x = i % width;
    FilmPixel& pixel = film.pixels[static_cast<std::size_t>(i)];
    const float spread = x < width / 2 ? 1.0f : 1.0f / static_cast<float>(right_divisor);
    const auto draw = [&] { return truth(x) * (1 + spread * (noise(engine) - 1)); };
    for (std::uint32_t s = 0; s < spp; ++s) add_sample(pixel, s & 1, {draw(), draw(), draw()}, 1 / film.unit);
    pixel.taken = spp;
  }
  return film;
}

/// True relative error of the columns x0 <= x < x1.
double true_error(const Film& film, int x0, int x1) {
  double sum = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = x0; x < x1; ++x) {
      const Vec3f m = mean(film, film.at(x, y));
      const auto ref = static_cast<double>(truth(x));
      for (const float v : {m.x, m.y, m.z}) sum += std::pow(static_cast<double>(v) - ref, 2) / (ref * ref + 0.01);
    }
  }
  return std::sqrt(sum / (3.0 * height * (x1 - x0)));
}

}  // namespace

TEST_CASE("estimated error: close to the true one on noise of known size") {
  for (const std::uint32_t spp : {16u, 64u}) {
    const Film film = noisy_film(spp, 1);
    const double ratio = estimated_relative_error(film) / true_error(film, 0, width);
    CHECK(ratio == doctest::Approx(1).epsilon(0.03));
    const ImageError error = image_error(resolve(film), true_image());
    CHECK(estimated_relative_error(film) == doctest::Approx(std::sqrt(error.rel_mse)).epsilon(0.03));
  }
}

TEST_CASE("estimated error: by hand for one pixel") {
  Film film = make_film(1, 1, {0, 0, 1, 1}, 0, 1);
  add_sample(film.pixels[0], 0, {0.5f, 0.25f, 0}, 1);
  add_sample(film.pixels[0], 1, {0.25f, 0.25f, 0}, 1);
  film.pixels[0].taken = 2;
  // Red: ((0.5 - 0.25) / 2)^2 / (0.375^2 + 0.01); the others agree.
  const double expected = std::sqrt(0.125 * 0.125 / (0.375 * 0.375 + 0.01) / 3);
  CHECK(estimated_relative_error(film) == doctest::Approx(expected).epsilon(1e-6));
  CHECK(pixel_relative_error(film)[0] == doctest::Approx(expected).epsilon(1e-6));
}

TEST_CASE("estimated error: infinite while a half of any pixel is empty") {
  Film film = noisy_film(2, 1);
  CHECK(std::isfinite(estimated_relative_error(film)));
  film.pixels[5].rejected[1] = 1;
  CHECK(estimated_relative_error(film) == std::numeric_limits<double>::infinity());
  CHECK(std::isfinite(pixel_relative_error(film)[5]));  // from its neighbours
  CHECK(std::isinf(pixel_relative_error(make_film(3, 3, {0, 0, 3, 3}, 0, 1))[4]));
  CHECK(std::isinf(estimated_relative_error(make_film(3, 3, {0, 0, 3, 3}, 0, 1))));
}

TEST_CASE("pixel error: follows the noise from place to place") {
  const Film film = noisy_film(16, 4);
  const std::vector<float> errors = pixel_relative_error(film);
  REQUIRE(errors.size() == film.pixels.size());
  const auto average = [&](int x0, int x1) {
    double sum = 0;
    for (int y = 0; y < height; ++y) {
      for (int x = x0; x < x1; ++x) sum += std::pow(static_cast<double>(errors[film.index(x, y)]), 2);
    }
    return std::sqrt(sum / (height * (x1 - x0)));
  };
  CHECK(average(64, 92) == doctest::Approx(true_error(film, 64, 92)).epsilon(0.05));
  CHECK(average(100, 128) == doctest::Approx(true_error(film, 100, 128)).epsilon(0.05));
  CHECK(average(100, 128) < 0.5 * average(64, 92));
}

TEST_CASE("pixel error: an average over 7 x 7 pixels, fewer at the border") {
  Film film = make_film(20, 20, {0, 0, 20, 20}, 0, 1);
  for (FilmPixel& pixel : film.pixels) pixel.taken = 2;
  add_sample(film.at(10, 10), 0, {0.2f, 0.2f, 0.2f}, 1);
  add_sample(film.at(10, 10), 1, {-0.2f, -0.2f, -0.2f}, 1);  // mean 0: squared error 0.04 / 0.01 = 4
  const std::vector<float> errors = pixel_relative_error(film);
  const auto at = [&](int x, int y) { return static_cast<double>(errors[film.index(x, y)]); };
  CHECK(at(10, 10) == doctest::Approx(std::sqrt(4.0 / 49)));
  CHECK(at(7, 13) == doctest::Approx(std::sqrt(4.0 / 49)));
  CHECK(at(6, 10) == 0);
  CHECK(at(10, 14) == 0);
  Film corner = make_film(20, 20, {0, 0, 20, 20}, 0, 1);
  for (FilmPixel& pixel : corner.pixels) pixel.taken = 2;
  corner.at(0, 0) = film.at(10, 10);
  CHECK(static_cast<double>(pixel_relative_error(corner)[0]) == doctest::Approx(std::sqrt(4.0 / 16)));
}

TEST_CASE("film mean: by hand for two pixels that show different things") {
  Film film = make_film(2, 1, {0, 0, 2, 1}, 0, 8);
  const auto add = [&](int x, std::uint32_t half, float red) {
    add_sample(film.at(x, 0), half, {red, 2, 3}, 1 / film.unit);
    ++film.at(x, 0).taken;
  };
  add(0, 0, 1), add(0, 1, 4), add(1, 0, 7);
  CHECK(film_mean(film).error == std::numeric_limits<double>::infinity());
  add(1, 1, 7);
  CHECK(film_mean(film).mean == doctest::Approx((2.5 + 7 + 2 + 2 + 3 + 3) / 6));
  CHECK(film_mean(film).error ==
        doctest::Approx(0.5 * std::sqrt(0.25)));  // halves 2 and 3 in one pixel, alike in the other
}

TEST_CASE("image error: numbers by hand") {
  const ImageError error = image_error({0.2f, 0.5f, 1.0f}, {0.1f, 0.5f, 0.5f});
  CHECK(error.mse == doctest::Approx((0.01 + 0.25) / 3).epsilon(1e-6));
  CHECK(error.rmse == doctest::Approx(0.294392).epsilon(1e-5));
  CHECK(error.rel_mse == doctest::Approx((0.01 / 0.02 + 0.25 / 0.26) / 3).epsilon(1e-6));
  // sRGB: 0.484529 - 0.349190 and 1 - 0.735357.
  CHECK(error.psnr == doctest::Approx(-10 * std::log10((0.135339 * 0.135339 + 0.264643 * 0.264643) / 3)).epsilon(1e-5));
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

TEST_CASE("image error: equal images, and what is not a number") {
  const std::vector<float> image = {0.1f, 0.2f, 0.3f};
  CHECK(image_error(image, image).mse == 0);
  CHECK(image_error(image, image).psnr == std::numeric_limits<double>::infinity());
  const ImageError bad = image_error({std::numeric_limits<float>::quiet_NaN(), 0, 0}, image);
  CHECK(std::isnan(bad.mse));
  CHECK(std::isnan(bad.psnr));
}

TEST_CASE("few pixels: noise of known size does not rest on them, one bright sample does") {
  Film film = noisy_film(16, 1);
  CHECK_FALSE(rests_on_few_pixels(film));
  add_sample(film.at(100, 60), 0, {60 * 64, 60 * 64, 60 * 64}, 1 / film.unit);
  CHECK(rests_on_few_pixels(film));
  Crew crew(2);
  CHECK(rests_on_few_pixels(film, &crew));
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
