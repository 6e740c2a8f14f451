#include "app/files/checkpoint.h"

#include "core/image/image_io.h"
#include "tests/support/allocations.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

#include <thread>

using namespace tyndall;
namespace fs = std::filesystem;

namespace {

Film film_of(std::uint32_t taken) {
  Film film = make_film(6, 5, {0, 0, 6, 5}, 0, 1);
  for (FilmPixel& pixel : film.pixels) pixel.taken = taken;
  return film;
}

Embedded embedded(const Film&) { return {"{}", "", {"1", "scalar", true}}; }

}  // namespace

TEST_CASE("checkpoints: the film as it was when it was taken is written, unfinished; the next one replaces it" *
          doctest::skip(!has_openexr())) {
  const fs::path folder = scratch_folder("checkpoints"), file = folder / "a.exr";
  Checkpoints checkpoints(file, 0, embedded);
  Film film = film_of(3);
  CHECK(checkpoints.due());
  checkpoints.take(film);
  film = film_of(9);  // the render goes on at once
  checkpoints.finish();
  CHECK(read_film(file) == film_of(3));
  CHECK(read_film_label(file)->unfinished);
  checkpoints.take(film);
  checkpoints.finish();
  CHECK(read_film(file) == film_of(9));
  CHECK_FALSE(checkpoints.problem());
  CHECK(count_files(folder) == 1);
}

TEST_CASE("checkpoints: without memory for a copy the film itself is written, before the render goes on" *
          doctest::skip(!has_openexr())) {
  const fs::path file = scratch_folder("checkpoint_memory") / "a.exr";
  Checkpoints checkpoints(file, 0, embedded);
  const Film film = film_of(4);
  {
    const auto refusal = test::AllocationRefusal::of_size(film.pixels.size() * sizeof(FilmPixel));
    checkpoints.take(film);
    CHECK(refusal.refused() == 1);
    CHECK(checkpoints.due());
  }
  CHECK(read_film(file) == film);
  CHECK_FALSE(checkpoints.problem());
}

TEST_CASE("checkpoints: due after the interval; without one after 30 seconds at the earliest" *
          doctest::skip(!has_openexr())) {
  const fs::path file = scratch_folder("checkpoint_times") / "a.exr";
  Checkpoints often(file, 0.05, embedded), usual(file, std::nullopt, embedded);
  CHECK_FALSE(often.due());
  std::this_thread::sleep_for(std::chrono::milliseconds(60));
  CHECK(often.due());
  CHECK_FALSE(usual.due());
  often.take(film_of(1));
  often.finish();
  std::this_thread::sleep_for(std::chrono::milliseconds(60));
  CHECK(often.due());
}

TEST_CASE("checkpoints: one that fails is told once, leaves the one before it, and later ones are tried" *
          doctest::skip(!has_openexr())) {
  const fs::path folder = scratch_folder("checkpoint_fails"), file = folder / "sub" / "a.exr";
  Checkpoints checkpoints(file, 0, embedded);
  for (int i = 0; i < 2; ++i) {
    checkpoints.take(film_of(1));
    checkpoints.finish();
    CHECK(checkpoints.due());
    const auto problem = checkpoints.problem();
    CHECK(problem.has_value() == (i == 0));
    if (problem) CHECK(problem->find("No such file or directory") != std::string::npos);
  }
  fs::create_directory(folder / "sub");
  checkpoints.take(film_of(2));
  checkpoints.finish();
  CHECK_FALSE(checkpoints.problem());
  CHECK(read_film(file) == film_of(2));
}
