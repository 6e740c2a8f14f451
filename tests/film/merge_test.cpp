#include "tests/support/peak_memory.h"
#include "tests/support/pictures.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>

namespace tyndall::test::merge_test {

namespace {

/// A made-up sample: its radiance depends on pixel and index only; some are rejected, some truncated.
void take(Film& film, int x, int y, std::uint32_t index) {
  FilmPixel& pixel = film.at(x, y);
  const auto value = static_cast<float>((x * 31 + y * 17 + static_cast<int>(index) * 7) % 101) / 37.0f;
  const bool bad = (index + static_cast<std::uint32_t>(x)) % 11 == 3;
  add_sample(pixel, index & 1, {bad ? 1e9f : value, value * value, 1 / (1 + value)}, 1 / film.quantum);
  if (index % 5 == 2) ++pixel.truncated;
  ++pixel.taken;
}

/// Samples first ... last - 1 of each pixel.
Film film_of(std::uint32_t first, std::uint32_t last, bool emission = false) {
  Film film = make_film(6, 5, {1, 1, 5, 4}, first, 4, emission);
  for (std::size_t i = 0; i < film.emission.size(); ++i)
    for (std::uint32_t s = first; s < last; ++s)
      add_emission(film.emission[i], s & 1u, {static_cast<float>(i + s), 1, 0.1f}, 1 / film.quantum);
  for (int y = 1; y < 4; ++y) {
    for (int x = 1; x < 5; ++x) {
      for (std::uint32_t i = first; i < last; ++i) take(film, x, y, i);
    }
  }
  return film;
}

}  // namespace

TEST_CASE("merge: emission adds up where all parts have it, and is dropped else") {
  const Film whole = film_of(0, 13, true);
  CHECK(merged({{"b", film_of(6, 13, true)}, {"none", film_of(3, 3)}, {"a", film_of(0, 6, true)}}) == whole);
  CHECK(merged({{"b", film_of(6, 13, true)}, {"a", film_of(0, 6)}}) == film_of(0, 13));
  CHECK(merged({{"b", film_of(6, 13)}, {"a", film_of(0, 6, true)}}) == film_of(0, 13));
}

TEST_CASE("merge: a range that does not begin at 0, a single part, nothing but empty parts") {
  CHECK(merged({{"b", film_of(9, 12)}, {"a", film_of(7, 9)}}) == film_of(7, 12));
  CHECK(merged({{"a", film_of(2, 4)}}) == film_of(2, 4));
  CHECK(merged({{"a", film_of(2, 2)}, {"b", film_of(4, 4)}}) == film_of(2, 2));
}

TEST_CASE("merge: overlaps and holes are refused with both names and the range") {
  const std::string begin = ", expected them to begin at 8, where those of a end";
  CHECK_THROWS_WITH_AS(merged({{"a", film_of(0, 8)}, {"b", film_of(6, 10)}}),
                       ("b: found samples 6:10" + begin + " (they overlap in 6:8)").c_str(), MergeError);
  CHECK_THROWS_WITH_AS(merged({{"b", film_of(9, 10)}, {"a", film_of(0, 8)}}),
                       ("b: found samples 9:10" + begin + " (8:9 are missing)").c_str(), MergeError);
  CHECK_THROWS_WITH_AS(merged({{"a", film_of(0, 8)}, {"again", film_of(0, 8)}}),
                       ("again: found samples 0:8" + begin + " (they overlap in 0:8)").c_str(), MergeError);
  CHECK_THROWS_WITH_AS(merged({{"a", film_of(0, 8)}, {"b", film_of(2, 4)}}),
                       ("b: found samples 2:4" + begin + " (they overlap in 2:4)").c_str(), MergeError);
}

TEST_CASE("merge: a thousand random partitions, some merged in two steps, are the film of one run") {
  std::mt19937 engine(11);
  const Film whole = film_of(0, 24);
  for (int round = 0; round < 1000; ++round) {
    std::vector<FilmPart> parts;
    for (std::uint32_t from = 0, to = 0; from < 24; from = to) {
      to = std::min<std::uint32_t>(24, from + 1 + static_cast<std::uint32_t>(engine() % 7));
      parts.push_back({std::to_string(from), film_of(from, to)});
    }
    parts.push_back({"none", film_of(3, 3)});
    if (round % 2 == 0 && parts.size() > 2) {  // the first parts are merged before
      const auto middle = parts.begin() + 2;
      const FilmPart first{"first", merged({parts.begin(), middle})};
      parts.erase(parts.begin(), middle);
      parts.push_back(first);
    }
    std::shuffle(parts.begin(), parts.end(), engine);
    REQUIRE(merged(parts) == whole);
  }
}

TEST_CASE("merge: no more than three films are in memory, however many parts there are") {
  const Region region{0, 0, 300, 200};
  const auto part = [&](std::size_t index) {
    Film film = make_film(300, 200, region, static_cast<std::uint32_t>(index), 1);
    for (FilmPixel& pixel : film.pixels) pixel.taken = 1;
    return film;
  };
  std::vector<FilmPart> frames;
  for (std::size_t i = 0; i < 100; ++i) {
    frames.push_back({"a", make_film(300, 200, {0, 0, 1, 1}, static_cast<std::uint32_t>(i), 1)});
    frames.back().film.region = region;
  }
  const auto film_size = static_cast<std::int64_t>(300 * 200 * sizeof(FilmPixel));
  CHECK(peak_memory_of([&] { CHECK(merge(frames, part).at(7, 5).taken == 100); }) < 3 * film_size);
}

TEST_CASE("merge: a file that changes while it is merged is refused") {
  const std::vector<FilmPart> frames = {{"a", film_of(0, 4)}, {"b", film_of(4, 8)}};
  CHECK_THROWS_WITH_AS(merge(frames, [](std::size_t) { return film_of(0, 4); }),
                       "b: found other samples than a moment ago, expected a file that stays", MergeError);
}

TEST_CASE("merge: an interrupted part ends at other indices in other pixels") {
  Film interrupted = film_of(0, 3), rest = film_of(3, 8);
  take(interrupted, 4, 3, 3);
  CHECK_THROWS_WITH_AS(merged({{"a", interrupted}, {"b", rest}}),
                       "b: found samples 3:8, expected them to begin at 4, where those of a end (they overlap in 3:4)",
                       MergeError);
}

TEST_CASE("merge: parts of another picture are refused") {
  const Film a = film_of(0, 4);
  Film size = film_of(4, 8), region = film_of(4, 8), quantum = film_of(4, 8);
  size.width = 7;
  CHECK_THROWS_WITH_AS(merged({{"a", a}, {"b", size}}), "b: found an image of 7x5, expected 6x5 as in a", MergeError);
  region.region = {0, 1, 4, 4};
  CHECK_THROWS_WITH_AS(merged({{"a", a}, {"b", region}}), "b: found the region 0,1,4,4, expected 1,1,5,4 as in a",
                       MergeError);
  quantum.quantum = 8;
  CHECK_THROWS_AS(merged({{"a", a}, {"b", quantum}}), MergeError);
}

}  // namespace tyndall::test::merge_test
