#include "core/film/film.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>

namespace tyndall::test::film_test {

namespace {

Film one_pixel(std::uint32_t first_sample = 0, double quantum = 1) {
  return make_film(1, 1, {0, 0, 1, 1}, first_sample, quantum);
}

/// Numbers of many magnitudes and both signs.
std::vector<double> wild_numbers(int count) {
  std::mt19937 engine(1);
  std::normal_distribution<double> normal;
  std::vector<double> numbers;
  for (int i = 0; i < count; ++i) numbers.push_back(std::copysign(std::exp(8 * normal(engine)), normal(engine)));
  for (double& x : numbers) x = std::clamp(x, -0x1p29, 0x1p29);
  return numbers;
}

ExactSum sum_of(const std::vector<double>& numbers) {
  ExactSum sum;
  for (const double x : numbers) sum.add(x);
  return sum;
}

}  // namespace

TEST_CASE("exact sum: any order and any split gives the same limbs") {
  std::vector<double> numbers = wild_numbers(10000);
  const ExactSum expected = sum_of(numbers);
  std::mt19937 engine(2);
  for (int round = 0; round < 20; ++round) {
    std::shuffle(numbers.begin(), numbers.end(), engine);
    CHECK(sum_of(numbers) == expected);
    std::vector<ExactSum> parts(1 + engine() % 9);
    for (const double x : numbers) parts[engine() % parts.size()].add(x);
    ExactSum sum;
    for (const ExactSum& part : parts) sum.add(part);
    CHECK(sum == expected);
  }
}

TEST_CASE("exact sum: three at once get the same limbs as each alone") {
  const std::vector<double> numbers = wild_numbers(3000);
  ExactSum each[3], together[3];
  for (std::size_t i = 0; i < numbers.size(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k) each[k].add(numbers[i + k]);
    add_each(together, numbers[i], numbers[i + 1], numbers[i + 2]);
  }
  for (int k = 0; k < 3; ++k) CHECK(together[k] == each[k]);
}

TEST_CASE("exact sum: is the sum, also of negative numbers") {
  ExactSum sum;
  for (const double x : {0.75, -200.5, 1e-9, -0x1p-61, 3.0}) sum.add(x);
  CHECK(sum.value() == doctest::Approx(-196.75 + 1e-9).epsilon(1e-15).scale(0));
  sum = {};
  sum.add(-0x1p-61);
  CHECK(sum.value() == -0x1p-61);
  sum.add(-0x1p-62);  // below the last bit
  CHECK(sum.value() == -0x1p-61);
}

TEST_CASE("exact sum: a bright number leaves small ones beside it untouched") {
  ExactSum small, both;
  both.add(250.0);
  for (int i = 0; i < 1000; ++i) {
    small.add(1e-9);
    both.add(1e-9);
  }
  both.add(-250.0);
  CHECK(both == small);
  CHECK(std::abs(small.value() / 1e-6 - 1) < 1e-9);
}

TEST_CASE("film: 2^25 samples of 0.3 lose nothing") {
  Film film = one_pixel(0, 4);
  FilmPixel& pixel = film.pixels[0];
  for (std::uint32_t i = 0; i < 1u << 25; ++i) add_sample(pixel, i & 1, {0.3f, 0.0f, -0.3f}, 0.25);
  pixel.taken = 1u << 25;
  CHECK(mean(film, pixel).x == 0.3f);
  CHECK(mean(film, pixel).z == -0.3f);
  CHECK(half_mean(film, pixel, 1).x == 0.3f);
}

TEST_CASE("film: the limit of the sums is 2^24 numbers of 1023 units in each half, or 15 of the brightest") {
  ExactSum maximum, brightest;
  maximum.add(1022.99999);
  for (int doubling = 0; doubling < 24; ++doubling) maximum.add(ExactSum(maximum));
  CHECK(maximum.value() == doctest::Approx(1022.99999 * 0x1p24).epsilon(1e-12).scale(0));
  for (int i = 0; i < 15; ++i) brightest.add(0.99999 * sample_limit);
  CHECK(brightest.value() == doctest::Approx(15 * 0.99999 * sample_limit).epsilon(1e-12).scale(0));
  CHECK(maximum.high > 0);
  CHECK(maximum.low > 0);
}

TEST_CASE("film: a far small light keeps its radiance beside a unit of 2^20") {
  Film film = one_pixel(0, 0x1p20);
  FilmPixel& pixel = film.pixels[0];
  for (std::uint32_t i = 0; i < 1000; ++i) add_sample(pixel, i & 1, {1.234e-3f, 7.0f, 2.5f}, 0x1p-20);
  pixel.taken = 1000;
  CHECK(std::abs(static_cast<double>(mean(film, pixel).x) / static_cast<double>(1.234e-3f) - 1) < 1e-7);
  CHECK(mean(film, pixel).y == 7.0f);
}

TEST_CASE("film: what is not finite or too bright is counted and left out") {
  Film film = one_pixel(0, 2);
  FilmPixel& pixel = film.pixels[0];
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  add_sample(pixel, 0, {1, 2, 3}, 0.5);
  add_sample(pixel, 1, {3, 2, 1}, 0.5);
  add_sample(pixel, 0, {nan, 0, 0}, 0.5);
  add_sample(pixel, 1, {0, infinity, 0}, 0.5);
  add_sample(pixel, 0, {0, 0, -infinity}, 0.5);
  add_sample(pixel, 1, {0, 0, 0x1p31f}, 0.5);  // 2^30 units
  pixel.taken = 6;
  CHECK(pixel.rejected[0] == 2);
  CHECK(pixel.rejected[1] == 2);
  CHECK(mean(film, pixel) == Vec3f{2, 2, 2});
  CHECK(half_mean(film, pixel, 0) == Vec3f{1, 2, 3});
  add_sample(pixel, 0, {0x1.fffffep30f, -0x1.fffffep30f, 0}, 0.5);
  CHECK(pixel.rejected[0] == 2);
}

TEST_CASE("film: each half counts its own indices, wherever the first one is") {
  for (std::uint32_t first = 0; first < 4; ++first) {
    for (std::uint32_t taken = 0; taken < 5; ++taken) {
      Film film = one_pixel(first);
      film.pixels[0].taken = taken;
      std::uint32_t expected[2] = {0, 0};
      for (std::uint32_t i = first; i < first + taken; ++i) ++expected[i & 1];
      CHECK(counted(film, film.pixels[0], 0) == expected[0]);
      CHECK(counted(film, film.pixels[0], 1) == expected[1]);
    }
  }
}

TEST_CASE("film: black before the first sample and where all were rejected") {
  Film film = one_pixel();
  CHECK(mean(film, film.pixels[0]) == Vec3f{});
  add_sample(film.pixels[0], 0, {-0x1p30f, 0, 0}, 1);
  film.pixels[0].taken = 1;
  CHECK(counted(film, film.pixels[0], 0) == 0);
  CHECK(mean(film, film.pixels[0]) == Vec3f{});
}

TEST_CASE("film: the mean weighs every sample alike, also with halves of unequal size") {
  Film film = one_pixel();
  add_sample(film.pixels[0], 0, {3, 0, 0}, 1);
  add_sample(film.pixels[0], 1, {0, 0, 0}, 1);
  add_sample(film.pixels[0], 0, {6, 0, 0}, 1);
  film.pixels[0].taken = 3;
  CHECK(mean(film, film.pixels[0]).x == 3.0f);
}

TEST_CASE("film: the unit is the power of two at or above the brightest") {
  CHECK(film_quantum(0) == 1);
  CHECK(film_quantum(1) == 1);
  CHECK(film_quantum(1.0001) == 2);
  CHECK(film_quantum(15) == 16);
  CHECK(film_quantum(16) == 16);
  CHECK(film_quantum(0.3) == 0.5);
  CHECK(film_quantum(1e38) == 0x1p127);
  CHECK(std::isfinite(1 / film_quantum(1e-320)));
}

TEST_CASE("film: a region is addressed by the full image's coordinates") {
  Film film = make_film(10, 8, {2, 3, 6, 5}, 0, 1);
  CHECK(film.pixels.size() == 8);
  film.at(5, 4).taken = 7;
  CHECK(film.pixels.back().taken == 7);
  film.at(3, 3).taken = 1;
  film.at(2, 3).rejected[1] = 2;
  film.at(2, 4).truncated = 5;
  const FilmTotals sum = totals(film);
  CHECK(sum.samples == 8);
  CHECK(sum.rejected == 2);
  CHECK(sum.truncated == 5);
  CHECK(sum.min_taken == 0);
  CHECK(sum.max_taken == 7);
}

TEST_CASE("film: resolve gives the means, row by row") {
  Film film = make_film(2, 1, {0, 0, 2, 1}, 0, 1);
  add_sample(film.at(1, 0), 0, {0.5f, 0.25f, 2}, 1);
  film.at(1, 0).taken = 1;
  CHECK(resolve(film) == std::vector<float>{0, 0, 0, 0.5f, 0.25f, 2});
}

TEST_CASE("film: emission is summed apart, and rejected samples do not count in it") {
  Film film = make_film(1, 1, {0, 0, 1, 1}, 0, 4, true);
  CHECK(bytes_per_pixel(true) == bytes_per_pixel(false) + sizeof(EmissionSums));
  const float infinity = std::numeric_limits<float>::infinity();
  for (const Vec3f radiance : {Vec3f{1, 2, 3}, Vec3f{infinity, 0, 0}, Vec3f{3, 0, 1e-6f}}) {
    add_sample(film.pixels[0], 1, radiance, 0.25);
    add_emission(film.emission[0], 1, radiance, 0.25);
  }
  film.pixels[0].taken = 6;  // three of them are in half 0 and met no light
  CHECK(half_emission(film, 0, 0) == Vec3f{});
  CHECK(half_emission(film, 0, 1).x == 2);
  CHECK(half_emission(film, 0, 1).y == 1);
  CHECK(half_emission(film, 0, 1).z == doctest::Approx(1.5 + 0.5e-6).epsilon(1e-8));
  EmissionSums twice = film.emission[0];
  add_emission(twice, film.emission[0]);
  CHECK(twice.sum[1][0] == 2 * film.emission[0].sum[1][0]);
  film.emission.clear();
  CHECK(half_emission(film, 0, 1) == Vec3f{});
}

// Reference: FNV-1a over the bytes 01000000 01000000 0000803f 0000003f 00000000, by hand (a few lines of Python).
TEST_CASE("image hash: FNV-1a of size and means, minus zero as zero") {
  CHECK(image_hash(1, 1, {1, 0.5f, 0}) == 0xc8ec25a66acc9dd5u);
  CHECK(image_hash(1, 1, {1, 0.5f, -0.0f}) == 0xc8ec25a66acc9dd5u);
  CHECK(image_hash(2, 1, {1, 0.5f, 0.25f, -2, 3, 1e-3f}) == 0xa9b95c813ccbf70cu);
  CHECK(image_hash(1, 2, {1, 0.5f, 0.25f, -2, 3, 1e-3f}) != 0xa9b95c813ccbf70cu);
}

TEST_CASE("checksum: every bit of a film and its text counts") {
  Film film = make_film(9, 8, {1, 2, 4, 5}, 7, 2, true);
  std::set<std::uint64_t> seen = {film_checksum(film, "text")};
  const auto is_new = [&] { return seen.insert(film_checksum(film, "text")).second; };
  const auto flip_all = [&](void* data, std::size_t size) {
    auto* bytes = static_cast<unsigned char*>(data);
    for (std::size_t bit = 0; bit < 8 * size; ++bit) {
      bytes[bit / 8] ^= static_cast<unsigned char>(1u << bit % 8);
      REQUIRE(is_new());
      bytes[bit / 8] ^= static_cast<unsigned char>(1u << bit % 8);
    }
  };
  flip_all(film.pixels.data(), film.pixels.size() * sizeof(FilmPixel));
  flip_all(film.emission.data(), film.emission.size() * sizeof(EmissionSums));
  flip_all(&film.width, sizeof film.width);
  flip_all(&film.height, sizeof film.height);
  flip_all(&film.region, sizeof film.region);
  flip_all(&film.first_sample, sizeof film.first_sample);
  flip_all(&film.quantum, sizeof film.quantum);
  flip_all(&film.cut_throughput, sizeof film.cut_throughput);
  for (const char* text : {"", "texu", "tex", "texts", "Text"}) CHECK(seen.insert(film_checksum(film, text)).second);
  CHECK_FALSE(is_new());
}

}  // namespace tyndall::test::film_test
