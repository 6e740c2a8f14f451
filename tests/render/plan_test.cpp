#include "core/render/plan.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <functional>

namespace tyndall::test::plan_test {

namespace {

constexpr int width = 67, height = 41;  // so the last cells of each row and column are smaller than the others

/// A film with `taken` samples a pixel of grey 0.5; one half is above that by spread(x, y), the other below it.
Film film_of(std::uint32_t taken, const std::function<double(int x, int y)>& spread) {
  Film film = make_film(width, height, {0, 0, width, height}, 0, 1);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      FilmPixel& pixel = film.at(x, y);
      pixel.taken = taken;
      for (std::uint32_t i = 0; i < taken; ++i) {
        const auto grey = static_cast<float>(0.5 + (i % 2 == 0 ? 1 : -1) * spread(x, y));
        add_sample(pixel, i & 1u, {grey, grey, grey}, 1);
      }
    }
  return film;
}

/// A spread that is large within a disc and small elsewhere.
double disc(int x, int y) { return (x - 20) * (x - 20) + (y - 20) * (y - 20) < 100 ? 0.2 : 0.01 + 1e-5 * (x + y); }

std::uint64_t total(const std::vector<std::uint32_t>& counts) {
  std::uint64_t sum = 0;
  for (const std::uint32_t count : counts) sum += count;
  return sum;
}

ThreadPool& one_thread() {
  static ThreadPool thread_pool(1);
  return thread_pool;
}

std::size_t index(int x, int y) { return static_cast<std::size_t>(y * width + x); }

/// The number of samples that the cell of a pixel is planned to get.
std::uint32_t planned_at(const Film& film, int x, int y) {
  return film.planned[static_cast<std::size_t>(y / cell_edge * ((width + cell_edge - 1) / cell_edge) + x / cell_edge)]
      .to;
}

}  // namespace

TEST_CASE("plan: more samples where the halves differ, their mean doubled and not a sample above") {
  Film film = film_of(warm_up, disc);
  CHECK(planned_mean(film) == 0);
  plan_round(film, one_thread());
  CHECK(planned_mean(film) == 2 * warm_up);
  const auto counts = counts_at(film, 2 * warm_up);
  CHECK(total(counts) <= 2 * warm_up * film.pixels.size());
  CHECK(total(counts) > 2 * warm_up * film.pixels.size() - 2 * 16);
  CHECK(counts[index(20, 20)] >= 4 * warm_up);
  CHECK(counts[index(60, 5)] == warm_up);
  const auto odd = [](const PlannedSamples& p) { return !std::has_single_bit(p.to); };
  CHECK(std::count_if(film.planned.begin(), film.planned.end(), odd) <= 1);  // takes what is left over
}

TEST_CASE("plan: never less than a quarter of the mean, never more than 16 times") {
  Film film = film_of(1024, [](int x, int y) { return x == 30 && y == 20 ? 0.4 : 0; });
  for (FilmPixel& pixel : film.pixels) pixel.taken = 16;  // few, so that the lower limit decides for most cells
  film.planned.assign(17 * 11, {8, 16});
  for (std::uint32_t mean = 32; mean <= 256; mean *= 2) {
    plan_round(film, one_thread());
    REQUIRE(planned_mean(film) == mean);
    for (const PlannedSamples& p : film.planned) {
      CHECK(p.to >= mean / 4);
      CHECK(p.to <= 16 * mean);
    }
    const auto counts = counts_at(film, mean);
    for (std::size_t i = 0; i < counts.size(); ++i) film.pixels[i].taken = counts[i];
  }
  CHECK(film.pixels[index(60, 5)].taken == 64);
  CHECK(film.pixels[index(34, 20)].taken > 1000);  // beside the pixel that differs
}

TEST_CASE("plan: where little is to be gained, all cells keep the same count") {
  for (const double wave : {0.0, 0.02}) {
    Film film = film_of(warm_up, [wave](int x, int) { return 0.1 + wave * (x / 16 % 2); });
    plan_round(film, one_thread());
    for (const PlannedSamples& p : film.planned) REQUIRE(p == PlannedSamples{warm_up, 2 * warm_up});
  }
  Film black = film_of(warm_up, [](int, int) { return 0; });
  plan_round(black, one_thread());
  for (const PlannedSamples& p : black.planned) REQUIRE(p == PlannedSamples{warm_up, 2 * warm_up});
}

TEST_CASE("plan: a round is planned when it is due, and not again") {
  Film film = film_of(warm_up, disc);
  CHECK(end_of_round(film, 3, one_thread()) == warm_up);
  CHECK(film.planned.empty());
  CHECK_FALSE(planned_unevenly(film));
  CHECK(end_of_round(film, warm_up, one_thread()) == 2 * warm_up);
  CHECK(planned_unevenly(film));
  const Film planned = film;
  film.at(60, 5) = {};
  film.at(60, 5).taken = 20;
  CHECK(end_of_round(film, 20, one_thread()) == 2 * warm_up);
  CHECK(film.planned == planned.planned);
}

TEST_CASE("plan: a cell has no say in its own count, its neighbours have") {
  Film film = film_of(warm_up, disc),
       other =
           film_of(warm_up, [](int x, int y) { return x / cell_edge == 12 && y / cell_edge == 5 ? 0.3 : disc(x, y); });
  plan_round(film, one_thread());
  plan_round(other, one_thread());
  CHECK(planned_at(film, 48, 20) == warm_up);
  CHECK(planned_at(other, 48, 20) == warm_up);
  for (const int beside : {-8, -4, 4, 8}) CHECK(planned_at(other, 48 + beside, 20) > warm_up);
  CHECK(planned_at(other, 60, 20) == warm_up);
}

TEST_CASE("plan: on the way through a round counts only grow, and fit into the mean") {
  Film film = film_of(warm_up, disc);
  plan_round(film, one_thread());
  std::vector<std::uint32_t> before = counts_at(film, warm_up);
  CHECK(before == std::vector<std::uint32_t>(film.pixels.size(), warm_up));
  for (std::uint32_t spp = warm_up + 1; spp <= 2 * warm_up; ++spp) {
    const std::vector<std::uint32_t> counts = counts_at(film, spp);
    CHECK(total(counts) <= spp * film.pixels.size());
    CHECK(static_cast<double>(total(counts)) > (spp - 0.1) * static_cast<double>(film.pixels.size()));
    for (std::size_t i = 0; i < counts.size(); ++i) REQUIRE(counts[i] >= before[i]);
    before = counts;
  }
  CHECK(counts_at(film, 1000) == before);  // beyond the round's end counts stay as planned
}

TEST_CASE("plan: a crew changes nothing; pixels without samples in a half have no say") {
  Film alone = film_of(warm_up, disc), shared = alone;
  ThreadPool thread_pool(3);
  plan_round(alone, one_thread());
  plan_round(shared, thread_pool);
  CHECK(alone == shared);
  Film lost = film_of(warm_up, disc);
  for (int x = 0; x < width; ++x) lost.at(x, 8).rejected[0] = warm_up / 2;
  plan_round(lost, one_thread());
  CHECK(planned_mean(lost) == 2 * warm_up);
}

TEST_CASE("plan: pictures smaller than a cell") {
  Film film = make_film(2, 1, {0, 0, 2, 1}, 0, 1);
  for (FilmPixel& pixel : film.pixels) pixel.taken = warm_up;
  for (std::uint32_t mean = 2 * warm_up; mean <= 1024; mean *= 2) {
    plan_round(film, one_thread());
    REQUIRE(planned_mean(film) == mean);
    REQUIRE(counts_at(film, mean) == std::vector<std::uint32_t>(2, mean));
    for (FilmPixel& pixel : film.pixels) pixel.taken = mean;
  }
}

TEST_CASE("plan: a picture is labelled with what all pixels have, or with their mean") {
  Film film = film_of(warm_up, disc);
  film.pixels[0].taken = 3;
  CHECK(labelled_spp(film) == 3);
  film.pixels[0].taken = warm_up;
  plan_round(film, one_thread());
  const auto counts = counts_at(film, 27);
  for (std::size_t i = 0; i < counts.size(); ++i) film.pixels[i].taken = counts[i];
  CHECK(labelled_spp(film) == 27);
}

}  // namespace tyndall::test::plan_test
