#include "app/files/checkpoint.h"

#include "core/base/seconds.h"
#include "core/image/image_io.h"
#include "tests/support/allocations.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

#include <chrono>
#include <thread>

namespace tyndall::test::checkpoint_test {
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
  ThreadPool thread_pool(2);
  Film film = film_of(3);
  CHECK(checkpoints.due());
  checkpoints.take(film, thread_pool);
  film = film_of(9);  // the render goes on at once
  checkpoints.finish();
  CHECK(read_film(file) == film_of(3));
  CHECK(read_film_label(file)->unfinished);
  checkpoints.take(film, thread_pool);
  checkpoints.finish();
  CHECK(read_film(file) == film_of(9));
  CHECK_FALSE(checkpoints.problem());
  CHECK(count_files(folder) == 1);
}

TEST_CASE("checkpoints: without memory for a copy the film itself is written, before the render goes on" *
          doctest::skip(!has_openexr())) {
  const fs::path file = scratch_folder("checkpoint_memory") / "a.exr";
  Checkpoints checkpoints(file, 0, embedded);
  ThreadPool thread_pool(2);
  const Film film = film_of(4);
  {
    const auto refusal = test::AllocationRefusal::of_size(film.pixels.size() * sizeof(FilmPixel));
    checkpoints.take(film, thread_pool);
    CHECK(refusal.refused() == 1);
    CHECK(checkpoints.due());
  }
  CHECK(read_film(file) == film);
  CHECK_FALSE(checkpoints.problem());
}

TEST_CASE("checkpoints: the first one is due after half of the interval, without an interval after 30 seconds" *
          doctest::skip(!has_openexr())) {
  const fs::path file = scratch_folder("checkpoint_times") / "a.exr";
  Checkpoints often(file, 2, embedded), usual(file, std::nullopt, embedded);
  ThreadPool thread_pool(2);
  CHECK_FALSE(often.due());
  std::this_thread::sleep_for(std::chrono::milliseconds(1000));
  CHECK(often.due());
  CHECK_FALSE(usual.due());
  often.take(film_of(1), thread_pool);
  often.finish();
  CHECK_FALSE(often.due());
}

TEST_CASE("checkpoints: later ones begin earlier than the interval by twice what the slowest one took" *
          doctest::skip(!has_openexr())) {
  const fs::path file = scratch_folder("checkpoint_early") / "a.exr";
  bool slow = true;
  const auto slowly = [&slow](const Film& film) {
    if (slow) std::this_thread::sleep_for(std::chrono::milliseconds(350));
    return embedded(film);
  };
  Checkpoints checkpoints(file, 2, slowly);
  ThreadPool thread_pool(2);
  checkpoints.take(film_of(1), thread_pool);
  CHECK_FALSE(checkpoints.due());  // it is being written
  checkpoints.finish();
  slow = false;
  const auto begun = std::chrono::steady_clock::now();
  checkpoints.take(film_of(1), thread_pool);
  while (!checkpoints.due() && seconds_since(begun) < 20) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  CHECK(seconds_since(begun) > 0.99);
  CHECK(seconds_since(begun) < 1.7);
  CHECK_FALSE(checkpoints.problem());
}

TEST_CASE("checkpoints: it is told once that they take longer than half of the interval" *
          doctest::skip(!has_openexr())) {
  const auto slowly = [](const Film& film) {
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    return embedded(film);
  };
  Checkpoints checkpoints(scratch_folder("checkpoint_slow") / "a.exr", 0.05, slowly);
  ThreadPool thread_pool(2);
  for (const bool first : {true, false}) {
    checkpoints.take(film_of(1), thread_pool);
    checkpoints.finish();
    const auto problem = checkpoints.problem();
    CHECK(problem.has_value() == first);
    if (problem) CHECK(problem->find("--checkpoint") != std::string::npos);
  }
}

TEST_CASE("checkpoints: a film is copied whole, whatever the number of its pixels and of the threads" *
          doctest::skip(!has_openexr())) {
  const fs::path file = scratch_folder("checkpoint_copy") / "a.exr";
  for (const int width : {1, 4096, 8193}) {
    CAPTURE(width);
    Film film = make_film(width, 1, {0, 0, width, 1}, 3, 0.5, width != 4096);
    film.cut_throughput.add(0.25);
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
      film.pixels[i].taken = static_cast<std::uint32_t>(i + 1);
      film.pixels[i].sum[1][2].add(0.5 * static_cast<double>(i % 7));
      if (!film.emission.empty()) film.emission[i].sum[1][2] = static_cast<std::int64_t>(i);
    }
    for (const int threads : {1, 3}) {
      Checkpoints checkpoints(file, 0, embedded);
      ThreadPool thread_pool(threads);
      checkpoints.take(film, thread_pool);
      checkpoints.finish();
      CHECK(read_film(file) == film);
      film.planned.assign(static_cast<std::size_t>((width + 3) / 4), PlannedSamples{0, film.pixels.back().taken});
    }
  }
}

TEST_CASE("checkpoints: one that fails is told once, leaves the one before it, and later ones are tried" *
          doctest::skip(!has_openexr())) {
  const fs::path folder = scratch_folder("checkpoint_fails"), file = folder / "sub" / "a.exr";
  Checkpoints checkpoints(file, 0, embedded);
  ThreadPool thread_pool(2);
  for (int i = 0; i < 2; ++i) {
    checkpoints.take(film_of(1), thread_pool);
    checkpoints.finish();
    CHECK(checkpoints.due());
    const auto problem = checkpoints.problem();
    CHECK(problem.has_value() == (i == 0));
    if (problem) CHECK(problem->find("No such file or directory") != std::string::npos);
  }
  fs::create_directory(folder / "sub");
  checkpoints.take(film_of(2), thread_pool);
  checkpoints.finish();
  CHECK_FALSE(checkpoints.problem());
  CHECK(read_film(file) == film_of(2));
}

}  // namespace tyndall::test::checkpoint_test
