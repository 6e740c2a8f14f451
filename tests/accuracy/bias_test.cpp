#include "core/accuracy/error.h"

#include <doctest/doctest.h>

#include <random>

namespace tyndall::test::bias_test {

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

}  // namespace tyndall::test::bias_test
