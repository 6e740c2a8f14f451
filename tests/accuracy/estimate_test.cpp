#include "core/accuracy/estimate.h"
#include "tests/support/capture.h"

#include "core/accuracy/error.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>

namespace tyndall::test::estimate_test {

namespace {

constexpr int width = 192, height = 128;

/// What the synthetic film would converge to: a ramp from nearly black to bright.
float truth(int x) { return 0.02f * std::exp2(static_cast<float>(x) / 20.0f); }

std::vector<float> true_image() {
  std::vector<float> image;
  for (int i = 0; i < width * height; ++i) image.insert(image.end(), 3, truth(i % width));
  return image;
}

/// Samples with exponential noise (standard deviation = mean).
Film noisy_film(std::uint32_t spp) {
  Film film = make_film(width, height, {0, 0, width, height}, 0, 64);
  std::mt19937 engine(3);
  std::exponential_distribution<float> noise;
  for (int i = 0; i < width * height; ++i) {
    const int x = i % width;
    FilmPixel& pixel = film.pixels[static_cast<std::size_t>(i)];
    const auto draw = [&] { return truth(x) * noise(engine); };
    for (std::uint32_t s = 0; s < spp; ++s) add_sample(pixel, s & 1, {draw(), draw(), draw()}, 1 / film.quantum);
    pixel.taken = spp;
  }
  return film;
}

}  // namespace

TEST_CASE("estimated error: close to the true one on noise of known size") {
  for (const std::uint32_t spp : {16u, 64u}) {
    const Film film = noisy_film(spp);
    const ImageError error = image_error(resolve(film), true_image());
    CHECK(estimate_error(film).relative_error == doctest::Approx(std::sqrt(error.rel_mse)).epsilon(0.03).scale(0));
  }
}

TEST_CASE("estimated error: by hand for one pixel") {
  Film film = make_film(1, 1, {0, 0, 1, 1}, 0, 1);
  add_sample(film.pixels[0], 0, {0.5f, 0.25f, 0}, 1);
  add_sample(film.pixels[0], 1, {0.25f, 0.25f, 0}, 1);
  film.pixels[0].taken = 2;
  // Red: ((0.5 - 0.25) / 2)^2 / (0.375^2 + 0.01); the others agree.
  const double expected = std::sqrt(0.125 * 0.125 / (0.375 * 0.375 + 0.01) / 3);
  CHECK(estimate_error(film).relative_error == doctest::Approx(expected).epsilon(1e-6).scale(0));
  CHECK(pixel_relative_error(film)[0] == doctest::Approx(expected).epsilon(1e-6).scale(0));
}

TEST_CASE("estimated error: infinite while a half of any pixel is empty") {
  Film film = noisy_film(2);
  CHECK(std::isfinite(estimate_error(film).relative_error));
  film.pixels[5].rejected[1] = 1;
  CHECK(estimate_error(film).relative_error == std::numeric_limits<double>::infinity());
  CHECK(std::isfinite(pixel_relative_error(film)[5]));  // from its neighbours
  CHECK(std::isinf(pixel_relative_error(make_film(3, 3, {0, 0, 3, 3}, 0, 1))[4]));
  CHECK(std::isinf(estimate_error(make_film(3, 3, {0, 0, 3, 3}, 0, 1)).relative_error));
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

TEST_CASE("estimated error: samples that are rare and bright do not hide how wrong their pixels are") {
  // One sample in 20 is 18.1, the others 0.1: the true level is 1. Were g the pixel's own mean, each bright pixel would
  // count 1 at most.
  Film film = make_film(width, height, {0, 0, width, height}, 0, 64);
  std::mt19937 engine(5);
  double sum = 0;
  for (FilmPixel& pixel : film.pixels) {
    for (std::uint32_t s = 0; s < 16; ++s) {
      const float value = engine() % 20 == 0 ? 18.1f : 0.1f;
      add_sample(pixel, s & 1, {value, value, value}, 1 / film.quantum);
    }
    pixel.taken = 16;
    sum += std::pow(static_cast<double>(mean(film, pixel).x) - 1, 2) / 1.01;
  }
  const double expected = std::sqrt(sum / (width * height));
  CHECK(expected > 0.9);
  CHECK(estimate_error(film).relative_error == doctest::Approx(expected).epsilon(0.1).scale(0));
}

namespace {

/// A film of 9 x 9 pixels: both halves are 0.3 everywhere except in the middle pixel, where they are the given numbers.
Film flat_film(float middle_a, float middle_b) {
  Film film = make_film(9, 9, {0, 0, 9, 9}, 0, 4);
  for (int i = 0; i < 81; ++i) {
    FilmPixel& pixel = film.pixels[static_cast<std::size_t>(i)];
    for (const std::uint32_t half : {0u, 1u}) {
      const float value = i != 40 ? 0.3f : half == 0 ? middle_a : middle_b;
      add_sample(pixel, half, {value, value, value}, 1 / film.quantum);
    }
    pixel.taken = 2;
  }
  return film;
}

}  // namespace

TEST_CASE("estimated error: by hand for a pixel that one half shows bright, and for one that both do") {
  const double rare = squared_relative_errors(flat_film(8.3f, 0.3f))[40];
  CHECK(rare == doctest::Approx(4.0 * 4.0 / (0.3 * 0.3 + 0.01)).epsilon(1e-5).scale(0));  // against the level around it
  const double lamp = squared_relative_errors(flat_film(9, 7))[40];
  // n = 1, m = 8: w = 1 - 4 / 64, g = 0.3 + w 7.7.
  CHECK(lamp == doctest::Approx(1 / (std::pow(0.3 + 0.9375 * 7.7, 2) + 0.01)).epsilon(1e-5).scale(0));
  const double both = squared_relative_errors(flat_film(9, 1))[40];
  CHECK(both == doctest::Approx(16 / (1 + 0.01)).epsilon(1e-5).scale(0));  // at least what both halves show
}

TEST_CASE("estimated error: the levels of the pixels that decide it are asked for, and taken") {
  // 40,000 pixels without an error, one that one half shows bright, and one a hundred times as wrong.
  Film film = make_film(200, 200, {0, 0, 200, 200}, 0, 64);
  for (FilmPixel& pixel : film.pixels) {
    for (const std::uint32_t half : {0u, 1u}) add_sample(pixel, half, {0.3f, 0.3f, 0.3f}, 1 / film.quantum);
    pixel.taken = 2;
  }
  add_sample(film.at(50, 60), 0, {8, 8, 8}, 1 / film.quantum);
  add_sample(film.at(150, 160), 1, {800, 800, 800}, 1 / film.quantum);
  const std::size_t rare = film.index(50, 60), lamp = film.index(150, 160);
  std::vector<std::vector<std::size_t>> query;
  const auto estimate = [&](Vec3f rare_level, Vec3f light_level) {
    query.clear();
    return estimate_error(film, nullptr, [&](const std::vector<std::size_t>& pixels) {
      query.push_back(pixels);
      std::vector<Vec3f> levels;
      for (const std::size_t pixel : pixels) levels.push_back(pixel == lamp ? light_level : rare_level);
      return levels;
    });
  };
  // With the level of a light its error is so small that the other one decides.
  const ErrorEstimate known = estimate({0.3f, 2, 0}, {400, 200, 100});
  CHECK(query == std::vector<std::vector<std::size_t>>{{lamp}, {rare}});
  const double of_light = 400.0 * 400 * (1 / 160000.01 + 1 / 40000.01 + 1 / 10000.01) / 3;
  const double of_rare = 4.0 * 4 * (1 / 0.1 + 1 / 4.01 + 1 / 0.01) / 3;
  CHECK(known.relative_error == doctest::Approx(std::sqrt((of_light + of_rare) / 40000)).epsilon(1e-5).scale(0));
  CHECK(known.rests_on_few_pixels);
  // A rare path's level hardly changes its error, and the rest stays hidden behind it.
  CHECK(estimate({}, {0.3f, 0.3f, 0.3f}).relative_error ==
        doctest::Approx(estimate_error(film).relative_error).epsilon(1e-3).scale(0));
  CHECK(query == std::vector<std::vector<std::size_t>>{{lamp}});
  // Where levels cannot be had, the film alone tells.
  const auto never = [](const std::vector<std::size_t>&) { return std::vector<Vec3f>(); };
  CHECK(estimate_error(film, nullptr, never).relative_error == estimate_error(film).relative_error);
}

TEST_CASE("estimated error: pixels known to be rare are as wrong as their means") {
  Film film = noisy_film(16);
  const std::size_t agreed = film.index(7, 5), plain = film.index(9, 20);
  film.pixels[agreed] = {};
  for (std::uint32_t half = 0; half < 2; ++half)
    for (int i = 0; i < 8; ++i) add_sample(film.pixels[agreed], half, {9, 9, 9}, 1 / film.quantum);
  film.pixels[agreed].taken = 16;
  std::vector<std::vector<std::size_t>> query;
  const auto levels_of = [&](const std::vector<std::size_t>& pixels) {
    query.push_back(pixels);
    return std::vector<Vec3f>(pixels.size(), Vec3f{1, 1, 1});
  };
  const std::vector<double> noise = squared_relative_errors(film);
  const Vec3f m = mean(film, film.pixels[plain]);
  const auto wrong = [](float value) {
    return (static_cast<double>(value) - 1) * (static_cast<double>(value) - 1) / 1.01;
  };
  double sum = wrong(9) + (wrong(m.x) + wrong(m.y) + wrong(m.z)) / 3;
  for (std::size_t i = 0; i < noise.size(); ++i) sum += i == agreed || i == plain ? 0 : noise[i];
  const std::vector<std::size_t> rare{std::min(agreed, plain), std::max(agreed, plain)};
  const double expected = std::sqrt(sum / static_cast<double>(noise.size()));
  CHECK(estimate_error(film, nullptr, levels_of, rare).relative_error == doctest::Approx(expected).epsilon(1e-5));
  CHECK(query.front() == rare);
  // Without levels they are like all others.
  const auto never = [](const std::vector<std::size_t>&) { return std::vector<Vec3f>(); };
  CHECK(estimate_error(film, nullptr, never, rare).relative_error == estimate_error(film).relative_error);
  film.pixels[plain] = {};
  CHECK(std::isinf(estimate_error(film, nullptr, levels_of, rare).relative_error));
}

TEST_CASE("estimated error: no levels are asked for where the noise is even") {
  const auto unwanted = [](const std::vector<std::size_t>& pixels) {
    FAIL("asked for " << pixels.size());
    return std::vector<Vec3f>();
  };
  CHECK(std::isfinite(estimate_error(noisy_film(16), nullptr, unwanted).relative_error));
}

TEST_CASE("estimated error: pixels that have an empty half tell nothing about the ones around them") {
  Film film = flat_film(8.3f, 0.3f);
  film.at(3, 4).rejected[1] = 1;
  film.at(3, 4).sum[0][0].add(100.0);
  const std::vector<double> errors = squared_relative_errors(film);
  CHECK(std::isinf(errors[39]));
  CHECK(errors[40] == doctest::Approx(4.0 * 4.0 / (0.3 * 0.3 + 0.01)).epsilon(1e-5).scale(0));
}

TEST_CASE("estimated error: the same bits for any number of threads, and pictures of any shape") {
  for (const auto& [columns, rows] : {std::pair{1, 1}, {1, 2}, {1, 97}, {97, 1}, {2, 33}, {5, 5}, {61, 67}}) {
    CAPTURE_BOUND(columns);
    CAPTURE_BOUND(rows);
    Film film = make_film(100, 100, {3, 2, 3 + columns, 2 + rows}, 0, 2);
    std::mt19937 engine(7);
    for (FilmPixel& pixel : film.pixels) {
      pixel.taken = static_cast<std::uint32_t>(2 + engine() % 5);  // unequal, as in the middle of a pass
      for (std::uint32_t s = 0; s < pixel.taken; ++s) {
        const auto value = static_cast<float>(engine() % 100) * 0.01f;
        add_sample(pixel, s & 1, {value, 1 - value, 0.5f}, 1 / film.quantum);
      }
    }
    const ErrorEstimate alone = estimate_error(film);
    const std::vector<double> errors = squared_relative_errors(film);
    double sum = 0;
    for (const double error : errors) sum += error;
    CHECK(std::isfinite(alone.relative_error));
    CHECK(alone.relative_error == doctest::Approx(std::sqrt(sum / static_cast<double>(errors.size()))));
    for (const int threads : {1, 2, 3}) {
      ThreadPool thread_pool(threads);
      CHECK(estimate_error(film, &thread_pool).relative_error == alone.relative_error);
      CHECK(squared_relative_errors(film, &thread_pool) == errors);
    }
  }
}

TEST_CASE("estimated error: the unit of a film does not matter, however bright or dim its lamps") {
  double bright = 0;  // the error of a film whose levels are far above 0.1
  for (const double quantum : {0x1p20, 0x1p60, 0x1p126, 0x1p-20, 0x1p-100}) {
    CAPTURE(quantum);
    Film film = make_film(8, 8, {0, 0, 8, 8}, 0, quantum);
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
      film.pixels[i].taken = 2;
      for (const std::uint32_t half : {0u, 1u}) film.pixels[i].sum[half][0].add(i % 3 == half ? 0.5 : 0.25);
    }
    const double error = estimate_error(film).relative_error;
    CHECK(std::isfinite(error));
    if (bright == 0) bright = error;
    if (quantum > 1)
      CHECK(error == doctest::Approx(bright).epsilon(1e-6).scale(0));
    else
      CHECK(error < quantum);  // black against 0.1
  }
}

TEST_CASE("few pixels: the error of even noise does not rest on a few of them, that of one bright sample does") {
  Film film = noisy_film(16);
  CHECK_FALSE(estimate_error(film).rests_on_few_pixels);
  add_sample(film.at(100, 60), 0, {60 * 64, 60 * 64, 60 * 64}, 1 / film.quantum);
  CHECK(estimate_error(film).rests_on_few_pixels);
  ThreadPool thread_pool(2);
  CHECK(estimate_error(film, &thread_pool).rests_on_few_pixels);
}

TEST_CASE("a black film has no error, but where there are lamps it is told that no light was found yet") {
  for (const bool lamps : {false, true}) {
    Film film = make_film(4, 3, {0, 0, 4, 3}, 0, 1, lamps);
    for (FilmPixel& pixel : film.pixels) {
      for (std::uint32_t half = 0; half < 2; ++half) add_sample(pixel, half, {0, 0, 0}, 1);
      pixel.taken = 2;
    }
    CHECK(estimate_error(film).relative_error == 0);
    CHECK(estimate_error(film).rests_on_few_pixels == lamps);
    for (std::uint32_t half = 0; half < 2; ++half) add_sample(film.pixels[5], half, {0, 1, 0}, 1);
    CHECK_FALSE(estimate_error(film).rests_on_few_pixels);
  }
}

}  // namespace tyndall::test::estimate_test
