#include "core/film/merge.h"

#include <doctest/doctest.h>

#include <algorithm>

using namespace tyndall;

namespace {

/// A made-up sample: its radiance depends on pixel and index only; some are rejected, some truncated.
void take(Film& film, int x, int y, std::uint32_t index) {
  FilmPixel& pixel = film.at(x, y);
  const auto value = static_cast<float>((x * 31 + y * 17 + static_cast<int>(index) * 7) % 101) / 37.0f;
  const bool bad = (index + static_cast<std::uint32_t>(x)) % 11 == 3;
  add_sample(pixel, index & 1, {bad ? 1e9f : value, value * value, 1 / (1 + value)}, 1 / film.unit);
  if (index % 5 == 2) ++pixel.truncated;
  ++pixel.taken;
}

/// Samples first ... last - 1 of each pixel.
Film film_of(std::uint32_t first, std::uint32_t last, bool emission = false) {
  Film film = make_film(6, 5, {1, 1, 5, 4}, first, 4, emission);
  for (std::size_t i = 0; i < film.emission.size(); ++i)
    for (std::uint32_t s = first; s < last; ++s)
      add_emission(film.emission[i], s & 1u, {static_cast<float>(i + s), 1, 0.1f}, 1 / film.unit);
  for (int y = 1; y < 4; ++y) {
    for (int x = 1; x < 5; ++x) {
      for (std::uint32_t i = first; i < last; ++i) take(film, x, y, i);
    }
  }
  return film;
}

}  // namespace

TEST_CASE("merge: parts in any order give the film of one run, bit for bit") {
  const std::vector<FilmPart> parts = {
      {"a", film_of(0, 5)}, {"b", film_of(5, 6)}, {"c", film_of(6, 13)}, {"none", film_of(3, 3)}};
  const Film whole = film_of(0, 13);
  std::vector<std::size_t> order = {0, 1, 2, 3};
  do {
    std::vector<FilmPart> shuffled;
    for (const std::size_t i : order) shuffled.push_back(parts[i]);
    CHECK(merge(shuffled) == whole);
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST_CASE("merge: emission adds up where all parts have it, and is dropped else") {
  const Film whole = film_of(0, 13, true);
  CHECK(merge({{"b", film_of(6, 13, true)}, {"none", film_of(3, 3)}, {"a", film_of(0, 6, true)}}) == whole);
  CHECK(merge({{"b", film_of(6, 13, true)}, {"a", film_of(0, 6)}}) == film_of(0, 13));
  CHECK(merge({{"b", film_of(6, 13)}, {"a", film_of(0, 6, true)}}) == film_of(0, 13));
}

TEST_CASE("merge: a range that does not begin at 0, a single part, nothing but empty parts") {
  CHECK(merge({{"b", film_of(9, 12)}, {"a", film_of(7, 9)}}) == film_of(7, 12));
  CHECK(merge({{"a", film_of(2, 4)}}) == film_of(2, 4));
  CHECK(merge({{"a", film_of(2, 2)}, {"b", film_of(4, 4)}}) == film_of(2, 2));
}

TEST_CASE("merge: overlaps and holes are refused") {
  CHECK_THROWS_WITH_AS(merge({{"a", film_of(0, 8)}, {"b", film_of(6, 10)}}),
                       "b: found samples from 6, expected from 8 (they overlap another part)", MergeError);
  CHECK_THROWS_WITH_AS(merge({{"b", film_of(9, 10)}, {"a", film_of(0, 8)}}),
                       "b: found samples from 9, expected from 8 (some are missing)", MergeError);
  CHECK_THROWS_AS(merge({{"a", film_of(0, 8)}, {"a again", film_of(0, 8)}}), MergeError);
}

TEST_CASE("merge: an interrupted part ends at other indices in other pixels") {
  Film interrupted = film_of(0, 3), rest = film_of(3, 8);
  take(interrupted, 4, 3, 3);
  CHECK_THROWS_WITH_AS(merge({{"a", interrupted}, {"b", rest}}),
                       "b: found samples from 3, expected from 4 (they overlap another part)", MergeError);
}

TEST_CASE("merge: parts of another picture are refused") {
  const Film a = film_of(0, 4);
  Film size = film_of(4, 8), region = film_of(4, 8), unit = film_of(4, 8);
  size.width = 7;
  CHECK_THROWS_WITH_AS(merge({{"a", a}, {"b", size}}), "b: found an image of 7x5, expected 6x5 as in a", MergeError);
  region.region = {0, 1, 4, 4};
  CHECK_THROWS_WITH_AS(merge({{"a", a}, {"b", region}}), "b: found the region 0,1,4,4, expected 1,1,5,4 as in a",
                       MergeError);
  unit.unit = 8;
  CHECK_THROWS_AS(merge({{"a", a}, {"b", unit}}), MergeError);
}
