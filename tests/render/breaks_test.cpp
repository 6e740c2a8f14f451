#include "tests/support/pictures.h"

#include <doctest/doctest.h>

namespace tyndall::test::breaks_test {

TEST_CASE("breaks: films and results that are taken in between change no bit, also with adaptive sampling") {
  const RenderScene scene = compile(small_scene("showroom", 100, 60, 1));
  for (const bool adaptive : {false, true}) {
    CAPTURE(adaptive);
    RenderOptions options{.threads = 2, .spp = 200, .adaptive = adaptive};
    const RenderResult plain = render(scene, options);
    int films = 0, results = 0;
    std::uint64_t last = 0;
    options.breaks.film_due = options.breaks.result_due = [] { return true; };
    options.breaks.take_film = [&](const Film& film, ThreadPool&) {
      const FilmTotals sum = totals(film);
      CHECK(sum.samples >= last);
      last = sum.samples;
      ++films;
    };
    options.breaks.take_result = [&](const RenderResult& result) {
      CHECK(totals(result.film).samples == last);
      CHECK_FALSE(result.interrupted);
      ++results;
    };
    const RenderResult error = render(scene, options);
    CHECK(films > 3);
    CHECK(results == films);
    CHECK(error.film == plain.film);
    CHECK(error.rays == plain.rays);
  }
}

TEST_CASE("breaks: a time limit still ends a render between passes, so that all pixels have as many samples") {
  const RenderScene scene = compile(small_scene("showroom", 100, 60, 1));
  RenderOptions options{.threads = 2, .time_limit = 0.3};
  options.breaks.film_due = [] { return true; };
  options.breaks.take_film = [](const Film&, ThreadPool&) {};
  const FilmTotals sum = totals(render(scene, options).film);
  CHECK(sum.min_taken > 0);
  CHECK(sum.min_taken == sum.max_taken);
}

}  // namespace tyndall::test::breaks_test
