#include "core/film/film.h"
#include "core/image/image_io.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

namespace tyndall::test::film_label_test {
namespace fs = std::filesystem;

namespace {

/// A film in the middle of a round of adaptive sampling; its size is no multiple of a cell's edge.
Film adaptive_film() {
  Film film = make_film(40, 30, {3, 2, 14, 11}, 0, 2);
  film.planned.resize(planned_cells(film.region));
  std::uint32_t count = 16;
  for (PlannedSamples& planned : film.planned) planned = {count, 2 * count + 2}, ++count;
  for (int y = 2; y < 11; ++y)
    for (int x = 3; x < 14; ++x) {
      const std::size_t cell = static_cast<std::size_t>((y - 2) / 4 * 3 + (x - 3) / 4);
      film.at(x, y).taken = film.planned[cell].from + static_cast<std::uint32_t>(x % 3);
    }
  return film;
}

const FilmLabel film_label = {"1.2.3", "scalar", true, "0123456789abcdef"};

}  // namespace

TEST_CASE("film label: version, instruction set and whether it is unfinished come back, of images and checkpoints" *
          doctest::skip(!has_openexr())) {
  const fs::path folder = scratch_folder("film_label");
  const Film film = adaptive_film();
  write_exr(folder / "whole.exr", film, {}, {"{}", "{\"spp\": 1}", film_label});
  write_checkpoint(folder / "checkpoint.exr", film, {"{}", "", film_label});
  for (const char* name : {"whole.exr", "checkpoint.exr"}) {
    CAPTURE(name);
    CHECK(read_film_label(folder / name) == film_label);
    CHECK(read_film(folder / name) == film);
    CHECK(read_embedded_scene(folder / name) == "{}");
    CHECK(read_embedded_contents(folder / name) == "0123456789abcdef");
  }
  CHECK(read_embedded_stats(folder / "whole.exr") == "{\"spp\": 1}");
  CHECK_FALSE(read_embedded_stats(folder / "checkpoint.exr"));
  CHECK_NOTHROW(read_image(folder / "whole.exr"));
  write_text(folder / "text.exr", "text");
  CHECK_FALSE(read_film_label(folder / "text.exr"));
}

TEST_CASE("film label: a film from before there were labels is read; one of a newer format is refused" *
          doctest::skip(!has_openexr())) {
  const fs::path folder = scratch_folder("film_formats"), old = tests_folder() / "image/film_of_format_0.exr";
  CHECK(read_film_label(old) == FilmLabel{});
  const auto film = read_film(old);
  REQUIRE(film);
  CHECK(totals(*film).samples == 2 * 8 * 6);
  write_exr(folder / "new.exr", *film, {}, {"{}", "", film_label});
  std::string bytes = read_text(folder / "new.exr");
  const std::string name = std::string("tyndall:film_format") + '\0' + "int" + '\0';
  const std::size_t at = bytes.find(name);
  REQUIRE(at != bytes.npos);
  bytes[at + name.size() + 4] = 9;
  write_text(folder / "new.exr", bytes);
  const std::string expected = (folder / "new.exr").string() +
                               ": cannot read: found a film in format 9, expected at most 1: "
                               "a newer version of Tyndall wrote it";
  CHECK_THROWS_WITH_AS(read_film(folder / "new.exr"), expected.c_str(), ImageFileError);
  CHECK_THROWS_WITH_AS(read_film_label(folder / "new.exr"), expected.c_str(), ImageFileError);
}

TEST_CASE("film label: rounds of adaptive sampling that contradict the counts are refused" *
          doctest::skip(!has_openexr())) {
  const fs::path file = scratch_folder("film_planned") / "a.exr";
  const auto refused = [&file](const Film& film) {
    write_checkpoint(file, film, {});
    CHECK_THROWS_AS(read_film(file), ImageFileError);
  };
  Film film = adaptive_film();
  film.planned.pop_back();
  refused(film);
  film = adaptive_film();
  film.planned[4].from = 1000;
  refused(film);
  film = adaptive_film();
  film.planned[0].to = film.planned[0].from;
  refused(film);
  film = adaptive_film();
  for (PlannedSamples& planned : film.planned) planned.to = 1u << 25u;
  refused(film);
}

}  // namespace tyndall::test::film_label_test
