#include "tests/support/sweep_films.h"

#include <doctest/doctest.h>

namespace tyndall::test::film_difference_test {

constexpr SweepStep gold{"showroom", "/materials/gold/fuzz", "0.18", "0.20", 48, 27};

TEST_CASE("film difference: its error is that of the difference, far below those of both pictures") {
  const SweepErrors errors = errors_of(gold, 6, 1024);
  CHECK(errors.ratio > 0.8);
  CHECK(errors.ratio < 1.25);
  CHECK(errors.gain > 3);
  CHECK(errors.deviations < 6);
  CHECK(errors.deviations > 0.05);
}

TEST_CASE("film difference: equal films differ by nothing, and one sample states no error") {
  const Film film = film_of(gold, gold.to, 1, 4), single = film_of(gold, gold.to, 1, 1);
  CHECK(film_difference(film, film).rms == 0);
  CHECK(film_difference(film, film).rms_error == 0);
  const FilmDifference noise = film_difference(film_of(gold, gold.to, 1, 16), film_of(gold, gold.to, 2, 16));
  CHECK(noise.rms < noise.rms_error);  // the products of two halves have no bias
  CHECK(std::isinf(film_difference(single, single).rms_error));
}

}  // namespace tyndall::test::film_difference_test
