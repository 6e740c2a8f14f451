#include "app/files/checkpoint.h"

#include "core/image/image_io.h"
#include "tests/support/allocations.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

#include <chrono>
#include <thread>

namespace tyndall::test::checkpoint_test {
namespace fs = std::filesystem;
using std::chrono::milliseconds;

namespace {

Film film_of(std::uint32_t taken) {
  Film film = make_film(6, 5, {0, 0, 6, 5}, 0, 1);
  for (FilmPixel& pixel : film.pixels) pixel.taken = taken;
  return film;
}

/// Checkpoints that take so long to write beside the disk's time.
struct Kept {
  std::string folder;
  std::optional<double> interval = 0;
  int threads = 2;
  milliseconds delay{0};
  fs::path file = scratch_folder(folder) / "a.exr";
  Checkpoints checkpoints{file, interval, [this](const Film&) {
                            std::this_thread::sleep_for(delay);
                            return Embedded{"{}", "", {"1", "scalar", true}};
                          }};
  ThreadPool thread_pool{threads};

  /// Takes one, and waits until it is written.
  void take(const Film& film) {
    checkpoints.take(film, thread_pool);
    checkpoints.finish();
  }
};

}  // namespace

TEST_SUITE("checkpoints" * doctest::skip(!has_openexr())) {
  TEST_CASE("checkpoints: the film as it was when it was taken is written, unfinished; the next one replaces it") {
    Kept kept{"checkpoints"};
    Film film = film_of(3);
    CHECK(kept.checkpoints.due());
    kept.checkpoints.take(film, kept.thread_pool);
    film = film_of(9);  // the render goes on at once
    kept.checkpoints.finish();
    CHECK(read_film(kept.file) == film_of(3));
    CHECK(read_film_label(kept.file)->unfinished);
    kept.take(film);
    CHECK(read_film(kept.file) == film_of(9));
    CHECK_FALSE(kept.checkpoints.problem());
    CHECK(count_files(kept.file.parent_path()) == 1);
  }

  TEST_CASE("checkpoints: without memory for a copy the film itself is written, before the render goes on") {
    Kept kept{"checkpoint_memory"};
    const Film film = film_of(4);
    {
      const auto refusal = test::AllocationRefusal::of_size(film.pixels.size() * sizeof(FilmPixel));
      kept.checkpoints.take(film, kept.thread_pool);
      CHECK(refusal.refused() == 1);
      CHECK(kept.checkpoints.due());
    }
    CHECK(read_film(kept.file) == film);
    CHECK_FALSE(kept.checkpoints.problem());
  }

  TEST_CASE("checkpoints: the first one is due after half of the interval, without an interval after 30 seconds") {
    Kept often{"checkpoint_times", 2}, usual{"checkpoint_times_usual", std::nullopt};
    CHECK_FALSE(often.checkpoints.due());
    std::this_thread::sleep_for(milliseconds(1000));
    CHECK(often.checkpoints.due());
    CHECK_FALSE(usual.checkpoints.due());
    often.take(film_of(1));
    CHECK_FALSE(often.checkpoints.due());
  }

  TEST_CASE("checkpoints: later ones begin earlier than the interval by twice what the slowest one took") {
    Kept kept{"checkpoint_early", 2, 2, milliseconds(350)};
    kept.checkpoints.take(film_of(1), kept.thread_pool);
    CHECK_FALSE(kept.checkpoints.due());  // it is being written
    kept.checkpoints.finish();
    kept.delay = {};
    const auto begun = Clock::now();
    kept.checkpoints.take(film_of(1), kept.thread_pool);
    while (!kept.checkpoints.due() && seconds_since(begun) < 20) std::this_thread::sleep_for(milliseconds(5));
    CHECK(seconds_since(begun) > 0.99);
    CHECK(seconds_since(begun) < 1.7);
    CHECK_FALSE(kept.checkpoints.problem());
  }

  TEST_CASE("checkpoints: it is told once that they take longer than half of the interval") {
    Kept kept{"checkpoint_slow", 0.05, 2, milliseconds(30)};
    kept.take(film_of(1));
    CHECK(kept.checkpoints.problem().value().find("--checkpoint") != std::string::npos);
    kept.take(film_of(1));
    CHECK_FALSE(kept.checkpoints.problem());
  }

  TEST_CASE("checkpoints: a film is copied whole, whatever the number of its pixels and of the threads") {
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
        Kept kept{"checkpoint_copy", 0, threads};
        kept.take(film);
        CHECK(read_film(kept.file) == film);
        film.planned.assign(static_cast<std::size_t>((width + 3) / 4), PlannedSamples{0, film.pixels.back().taken});
      }
    }
  }

  TEST_CASE("checkpoints: one that fails is told once, leaves the one before it, and later ones are tried") {
    Kept kept{"checkpoint_fails"};
    fs::remove(kept.file.parent_path());
    kept.take(film_of(1));
    CHECK(kept.checkpoints.due());
    CHECK(kept.checkpoints.problem().value().find("No such file or directory") != std::string::npos);
    kept.take(film_of(1));
    CHECK_FALSE(kept.checkpoints.problem());
    fs::create_directory(kept.file.parent_path());
    kept.take(film_of(2));
    CHECK_FALSE(kept.checkpoints.problem());
    CHECK(read_film(kept.file) == film_of(2));
  }

}  // TEST_SUITE

}  // namespace tyndall::test::checkpoint_test
