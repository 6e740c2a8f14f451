#include "core/film/film.h"

#include <doctest/doctest.h>

#include <cstring>
#include <set>

namespace tyndall::test::checksum_test {

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

}  // namespace tyndall::test::checksum_test
